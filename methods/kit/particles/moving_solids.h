// Solids that move or deform during a step, and paths of particles relative to them.
//
// The frame of a solid moves linearly from its pose at the step's start to that at its end, M(t) = (1 − t)·M0 + t·M1,
// so that each point of the solid has one velocity for the whole step, (M1·p − M0·p)/Δt. A path that ends outside of a
// solid in one step starts at the same position in the next, bit for bit.
//
// Relative to a point of its surface, a mesh that deforms is at rest. The start of a particle's path is moved with the
// nearest point of the surface until the step's end; the path is then tested against the shape at the end. A path that
// starts outside of the old shape therefore starts outside of the new one.
//
// Units: m, m/s, s. Frame: world, unless named local; of a deformation: the mesh's. Owns: trees of both shapes.
// Threads: const members are safe from any.
#pragma once

#include <glm/glm.hpp>
#include <memory>
#include <optional>

#include "methods/contract/solid.h"
#include "methods/kit/meshes/triangle_tree.h"

namespace dustbench::particles {

/// The frame of a solid that moves during a step.
class CarriedFrame {
 public:
    /// Sets the pose at a step's end. The first call extrapolates the pose at the start backwards with
    /// `velocity`.
    void moveTo(const glm::dmat4& toWorld, const glm::dvec3& velocity, double stepSeconds);

    /// `seconds`: time before the step's end.
    [[nodiscard]] glm::vec3 toLocal(const glm::vec3& point, float seconds) const;
    [[nodiscard]] glm::vec3 toWorld(const glm::vec3& local, float seconds) const;
    /// Rotates only.
    [[nodiscard]] glm::vec3 directionToWorld(const glm::vec3& local, float seconds) const;
    [[nodiscard]] glm::vec3 velocityOf(const glm::vec3& local) const;

    [[nodiscard]] const glm::dmat4& atBegin() const { return begin_; }
    [[nodiscard]] const glm::dmat4& atEnd() const { return *end_; }

 private:
    [[nodiscard]] glm::dmat4 before(float seconds) const;

    glm::dmat4 begin_{1};
    std::optional<glm::dmat4> end_;
    glm::dmat4 fromBegin_{1}, fromEnd_{1};  ///< inverses
    double stepSeconds_ = 1;
};

/// A mesh that deforms during a step.
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
