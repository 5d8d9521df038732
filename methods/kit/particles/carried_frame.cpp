#include "methods/kit/particles/carried_frame.h"

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

}  // namespace dustbench::particles
