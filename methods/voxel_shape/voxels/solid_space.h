// The interior of a scene's solids: a ray upwards from an inner point leaves a solid once more than it enters it.
//
// Independent of the collision code of the methods, so that experiments can check methods with it.
// Units: metres. Frame: world. Owns: copies of the triangles. Threads: one or many at a time.
#pragma once

#include <array>
#include <glm/glm.hpp>
#include <vector>

#include "methods/contract/scene.h"

namespace dustbench::voxel_shape {

class SolidSpace {
 public:
    /// Uses `scene.solids`, whose surfaces must be closed; neither the ground nor the vehicle.
    explicit SolidSpace(const scene::Scene& scene);
    /// Uses one closed mesh.
    SolidSpace(const scene::Mesh& mesh, const glm::mat4& toWorld) { add(mesh, toWorld); }

    /// Returns whether a solid contains the point. A point exactly below an edge may count as outside.
    [[nodiscard]] bool contains(const glm::dvec3& point) const;

 private:
    using Triangle = std::array<glm::dvec3, 3>;
    struct Body {
        std::vector<Triangle> triangles;  ///< sorted by minimum x
        glm::dvec3 minimum, maximum;      ///< bounding box of the triangles
        double widest;                    ///< maximum extent of a triangle along x
    };
    void add(const scene::Mesh& mesh, const glm::dmat4& toWorld);
    [[nodiscard]] static int exits(const Body& body, const glm::dvec3& point);

    std::vector<Body> bodies_;
};

}  // namespace dustbench::voxel_shape
