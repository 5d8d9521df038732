#include "methods/kit/particles/moving_solids.h"

#include <algorithm>

namespace dustbench::particles {

void CarriedFrame::moveTo(const glm::dmat4& toWorld, const glm::dvec3& velocity, double stepSeconds) {
    begin_ = end_.value_or(toWorld);
    if (!end_) begin_[3] -= glm::dvec4(velocity * stepSeconds, 0);
    end_ = toWorld;
    fromBegin_ = glm::inverse(begin_);
    fromEnd_ = glm::inverse(toWorld);
    stepSeconds_ = stepSeconds;
}

glm::dmat4 CarriedFrame::before(float seconds) const {
    const double left = static_cast<double>(seconds) / stepSeconds_;
    return left * begin_ + (1 - left) * *end_;
}

glm::vec3 CarriedFrame::toLocal(const glm::vec3& point, float seconds) const {
    const glm::dvec4 place(glm::dvec3(point), 1);
    if (seconds <= 0) return glm::vec3(fromEnd_ * place);
    if (seconds >= static_cast<float>(stepSeconds_)) return glm::vec3(fromBegin_ * place);
    return glm::vec3(glm::inverse(before(seconds)) * place);
}

glm::vec3 CarriedFrame::toWorld(const glm::vec3& local, float seconds) const {
    return glm::vec3(before(seconds) * glm::dvec4(glm::dvec3(local), 1));
}

glm::vec3 CarriedFrame::directionToWorld(const glm::vec3& local, float seconds) const {
    return glm::normalize(glm::vec3(before(seconds) * glm::dvec4(glm::dvec3(local), 0)));
}

glm::vec3 CarriedFrame::velocityOf(const glm::vec3& local) const {
    return glm::vec3((*end_ - begin_) * glm::dvec4(glm::dvec3(local), 1) / stepSeconds_);
}

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
