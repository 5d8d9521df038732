#include "methods/kit/particles/deformation.h"

#include <algorithm>

namespace dustbench::particles {
namespace {

meshes::TriangleTree treeOf(const scene::Mesh& mesh) {
    meshes::TriangleTree tree;
    tree.add(mesh, glm::mat4(1));
    tree.build();
    return tree;
}

}  // namespace

void Deformation::moveTo(const std::shared_ptr<const scene::DeformedMesh>& shape, double stepSeconds) {
    if (shape_) {
        positionsAtBegin_ = shape_->mesh.positions;
        atBegin_ = std::move(atEnd_);
    } else {
        scene::Mesh before = shape->mesh;
        for (std::size_t v = 0; v < before.positions.size(); ++v)
            before.positions[v] -= static_cast<float>(stepSeconds) * shape->velocities[v];
        positionsAtBegin_ = before.positions;
        atBegin_ = treeOf(before);
    }
    shape_ = shape;
    atEnd_ = treeOf(shape->mesh);
    stepSeconds_ = stepSeconds;
    farthestMetres_ = 0;
    for (std::size_t v = 0; v < positionsAtBegin_.size(); ++v)
        farthestMetres_ = std::max(farthestMetres_, glm::distance(positionsAtBegin_[v], shape->mesh.positions[v]));
}

glm::vec3 Deformation::velocityNear(const glm::vec3& point, float seconds, float wayMetres) const {
    const glm::vec3 velocity = velocityAtBegin(point, wayMetres);
    const float since = static_cast<float>(stepSeconds_) - seconds;
    if (since <= 0 || velocity == glm::vec3(0)) return velocity;
    return velocityAtBegin(point - since * velocity, wayMetres);  // its position on the surface at the start
}

glm::vec3 Deformation::velocityAtBegin(const glm::vec3& point, float wayMetres) const {
    const auto near = atBegin_.nearest(point, farthestMetres_ + wayMetres);
    return near ? velocityOf(*near) : glm::vec3(0);
}

glm::vec3 Deformation::velocityOfPointAtEnd(const glm::vec3& point) const {
    const auto near = atEnd_.nearest(point, 1e-3f * (1 + glm::length(point)));
    return near ? velocityOf(*near) : glm::vec3(0);
}

glm::vec3 Deformation::velocityOf(const meshes::TriangleTree::Nearest& point) const {
    glm::dvec3 way(0);
    for (std::size_t k = 0; k < 3; ++k) {
        const std::uint32_t v = shape_->mesh.indices[3 * point.triangle + k];
        way += point.weights[static_cast<int>(k)] *
               (glm::dvec3(shape_->mesh.positions[v]) - glm::dvec3(positionsAtBegin_[v]));
    }
    return glm::vec3(way / stepSeconds_);
}

std::size_t Deformation::bytes() const {
    return atBegin_.bytes() + atEnd_.bytes() + positionsAtBegin_.size() * sizeof(glm::vec3);
}

}  // namespace dustbench::particles
