// A mesh that changes its shape during a step, as a particle near it sees it.
//
// Seen from a point of the surface the surface stands still: a particle's way begins where the nearest point of the
// surface carries its begin until the step's end, and is then tested against the shape at that end. So what begins
// outside the old shape begins outside the new one.
//
// Units: m, m/s, s. Frame: the mesh's. Owns: trees of both shapes. Threads: const members are safe from any.
#pragma once

#include <memory>

#include "methods/contract/solid.h"
#include "methods/kit/meshes/triangle_tree.h"

namespace dustbench::particles {

class Deformation {
 public:
    /// Moves on to the shape at a step's end. The first time, the shape at its begin is that less the way that the
    /// velocities go. Throws InputError as meshes::TriangleTree does.
    void moveTo(const std::shared_ptr<const scene::DeformedMesh>& shape, double stepSeconds);

    /// The velocity of the surface where it is nearest to a point `seconds` before the step's end; 0 where it is
    /// farther away than anything can come that goes `wayMetres`.
    [[nodiscard]] glm::vec3 velocityNear(const glm::vec3& point, float seconds, float wayMetres) const;

    /// The velocity of the point of the surface that is here at the step's end.
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
    float farthestMetres_ = 0;  ///< that a vertex goes in this step
};

}  // namespace dustbench::particles
