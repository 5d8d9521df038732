// A mesh that deforms during a step, relative to a particle near it.
//
// Relative to a point of the surface, the surface is at rest. The start of a particle's path is moved with the nearest
// point of the surface until the step's end; the path is then tested against the shape at the end. A path that starts
// outside of the old shape therefore starts outside of the new one.
//
// Units: m, m/s, s. Frame: the mesh's. Owns: trees of both shapes. Threads: const members are safe from any.
#pragma once

#include <memory>

#include "methods/contract/solid.h"
#include "methods/kit/meshes/triangle_tree.h"

namespace dustbench::particles {

class Deformation {
 public:
    /// Sets the shape at a step's end. The first call extrapolates the shape at the start backwards with the
    /// velocities. Throws InputError as meshes::TriangleTree does.
    void moveTo(const std::shared_ptr<const scene::DeformedMesh>& shape, double stepSeconds);

    /// The velocity of the surface at the point nearest to `point`, `seconds` before the step's end; 0 if the surface
    /// is out of reach of a path of `wayMetres`.
    [[nodiscard]] glm::vec3 velocityNear(const glm::vec3& point, float seconds, float wayMetres) const;

    /// The velocity of the surface point that is here at the step's end.
    [[nodiscard]] glm::vec3 velocityOfPointAtEnd(const glm::vec3& point) const;

    [[nodiscard]] const meshes::TriangleTree& treeAtEnd() const { return atEnd_; }
    [[nodiscard]] const std::vector<glm::vec3>& positionsAtBegin() const { return positionsAtBegin_; }
    [[nodiscard]] const std::vector<glm::vec3>& positionsAtEnd() const { return shape_->mesh.positions; }
    [[nodiscard]] std::size_t bytes() const;

 private:
    [[nodiscard]] glm::vec3 velocityAtBegin(const glm::vec3& point, float wayMetres) const;
    [[nodiscard]] glm::vec3 velocityOf(const meshes::TriangleTree::Nearest& point) const;

    std::shared_ptr<const scene::DeformedMesh> shape_;
    std::vector<glm::vec3> positionsAtBegin_;
    meshes::TriangleTree atBegin_, atEnd_;
    double stepSeconds_ = 1;
    float farthestMetres_ = 0;  ///< maximum distance that a vertex moves in this step
};

}  // namespace dustbench::particles
