#include "methods/kit/particles/step.h"

namespace dustbench::particles {

std::span<const Emitter> EmitterTracker::follow(const scene::Scene& scene, const scene::SceneState& state,
                                                double seconds) {
    if (!scene.vehicle) {
        known_ = false;
        return {};
    }
    for (std::size_t i = 0; i < wheels_.size(); ++i) {
        const scene::WheelState& wheel = state.vehicle.wheels[i];
        Emitter& emitter = wheels_[i];
        emitter.from = known_ ? emitter.to : glm::vec3(wheel.contact - wheel.velocity * seconds);
        emitter.velocityFrom = known_ ? emitter.velocityTo : glm::vec3(wheel.velocity);
        emitter.to = glm::vec3(wheel.contact);
        emitter.velocityTo = glm::vec3(wheel.velocity);
        emitter.forward = glm::vec3(wheel.forward);
        emitter.right = glm::vec3(glm::normalize(glm::cross(wheel.forward, state.vehicle.up)));
        emitter.up = glm::cross(emitter.right, emitter.forward);
        emitter.speed = static_cast<float>(state.vehicle.speed);
    }
    known_ = true;
    return wheels_;
}

}  // namespace dustbench::particles
