// The space that a scene's solids take up: straight up from within it a solid is left once more than it is entered.
//
// Apart from what any method collides with: experiments hold methods against it.
// Units: metres. Frame: world. Owns: copies of the triangles. Threads: one or many at a time.
#pragma once

#include <array>
#include <glm/glm.hpp>
#include <vector>

#include "methods/contract/scene.h"

namespace dustbench::voxel_shape {

class SolidSpace {
 public:
    /// Of `scene.solids`, whose surfaces are closed; neither the ground nor the vehicle.
    explicit SolidSpace(const scene::Scene& scene);
    /// Of one closed mesh.
    SolidSpace(const scene::Mesh& mesh, const glm::mat4& toWorld) { add(mesh, toWorld); }

    /// A point that lies exactly below an edge may be taken for one outside.
    [[nodiscard]] bool contains(const glm::dvec3& point) const;

 private:
    using Triangle = std::array<glm::dvec3, 3>;
    struct Body {
        std::vector<Triangle> triangles;  ///< by their minimum x
        glm::dvec3 minimum, maximum;      ///< the box around them all
        double widest;                    ///< extent of a triangle along x
    };
    void add(const scene::Mesh& mesh, const glm::dmat4& toWorld);
    [[nodiscard]] static int exits(const Body& body, const glm::dvec3& point);

    std::vector<Body> bodies_;
};

}  // namespace dustbench::voxel_shape
