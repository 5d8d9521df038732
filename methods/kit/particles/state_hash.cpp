#include "methods/kit/particles/state_hash.h"

#include "methods/kit/maths/hash.h"

namespace dustbench::particles {
namespace {

void addVehicle(maths::Hash& hash, const scene::VehicleState& vehicle) {
    const auto add = [&](const glm::dvec3& v) { hash.add(v.x).add(v.y).add(v.z); };
    add(vehicle.position);
    hash.add(vehicle.heading).add(vehicle.speed).add(vehicle.acceleration).add(vehicle.steerAngle);
    add(vehicle.up);
    for (const scene::WheelState& wheel : vehicle.wheels) {
        add(wheel.hub);
        add(wheel.contact);
        add(wheel.velocity);
        add(wheel.forward);
        hash.add(wheel.steerAngle).add(wheel.spinAngle).add(wheel.spinRate);
    }
}

void addSolids(maths::Hash& hash, const std::vector<scene::SolidNow>& solids) {
    const auto add = [&](const glm::vec3& v) { hash.add(v.x).add(v.y).add(v.z); };
    for (const scene::SolidNow& solid : solids) {
        for (int column = 0; column < 4; ++column) add(glm::vec3(solid.pose.toWorld[column]));
        add(solid.pose.velocity);
        add(solid.pose.angularVelocity);
        if (!solid.shape) continue;
        for (const glm::vec3& position : solid.shape->mesh.positions) add(position);
        for (const glm::vec3& velocity : solid.shape->velocities) add(velocity);
    }
}

}  // namespace

std::uint64_t stateHash(const scene::SceneState& state, std::span<const std::uint64_t> systems) {
    maths::Hash hash;
    hash.add(state.timeSeconds);
    addVehicle(hash, state.vehicle);
    addSolids(hash, state.solids);
    for (const std::uint64_t system : systems) hash.add(system);
    return hash.value();
}

}  // namespace dustbench::particles
