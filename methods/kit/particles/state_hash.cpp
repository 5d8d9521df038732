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

}  // namespace

std::uint64_t stateHash(const scene::SceneState& state, std::span<const std::uint64_t> systems) {
    maths::Hash hash;
    hash.add(state.timeSeconds);
    addVehicle(hash, state.vehicle);
    for (const std::uint64_t system : systems) hash.add(system);
    return hash.value();
}

}  // namespace dustbench::particles
