// A simple world for tests: a car that drives straight at constant speed, and a system that uses every force.
#pragma once

#include <string>

#include "methods/kit/particles/part.h"
#include "methods/kit/particles/part_toml.h"
#include "methods/kit/particles/particle_system.h"

namespace dustbench::particles::test {

inline scene::Scene sceneWithCar() {
    scene::Scene scene;
    scene.wind = {1.5f, 0, -0.75f};
    scene.vehicle.emplace();
    return scene;
}

/// Along +X over flat ground; only basic arithmetic, so that states are the same on every machine.
inline scene::SceneState drivingStraight(double timeSeconds, double speed) {
    scene::SceneState state;
    state.timeSeconds = timeSeconds;
    state.vehicle.speed = speed;
    state.vehicle.position = {speed * timeSeconds, 0, 0};
    for (std::size_t i = 0; i < 4; ++i) {
        scene::WheelState& wheel = state.vehicle.wheels[i];
        wheel.velocity = {speed, 0, 0};
        wheel.contact = state.vehicle.position + glm::dvec3(i < 2 ? 2.6 : 0.0, 0, i % 2 ? 0.75 : -0.75);
        wheel.hub = wheel.contact + glm::dvec3(0, 0.33, 0);
    }
    return state;
}

inline const std::string everyForce = R"(
emission = { part = "stream", rate_per_second = 30, rate_per_metre = 25 }
position = { part = "disc", radius_metres = 0.2 }
velocity = { part = "cone", direction = [-0.5, 0.8, 0.1], half_angle_degrees = 50, speed = 0.5, speed_share = 0.15, variation = 0.6, inherit = 0.2 }
colour = { part = "constant", colour = [0.6, 0.5, 0.4], opacity_curve = "bezier" }
size = { part = "linear" }
life = [ { part = "lifetime", average_seconds = 0.8, variation_seconds = 0.5 } ]
force = [
    { part = "gravity", acceleration = 1.5 },
    { part = "drag", rate_per_second = 2.5 },
    { part = "wind", factor = 0.8, gust_speed = 0.7, gust_metres = 3 },
    { part = "ground", friction_per_second = 3 },
]
)";

inline ParticleSystem systemFrom(const std::string& toml, std::uint64_t seed = 1) {
    return ParticleSystem(partsFromText(toml, "test.toml"), seed);
}

/// Gives the system a lattice if the part works only with one.
inline void giveLattice(PartList& parts, const PartInfo& info) {
    if (info.create(ParameterValues(info.parameters))->needsLattice())
        parts.set(makePart(PartKind::position, "lattice"));
}

/// Advances `steps` steps behind the straight-driving car.
inline void advance(ParticleSystem& system, const scene::Scene& scene, int steps, double speed = 20,
                    std::int64_t fixedCount = 0, double stepSeconds = 1.0 / 60, int firstStep = 0) {
    for (int i = firstStep + 1; i <= firstStep + steps; ++i) {
        const scene::SceneState state = drivingStraight(i * stepSeconds, speed);
        scene::View view;  // of everything, from high above
        view.camera.eye = {0, 5000, 1};
        system.update({scene, state, stepSeconds, fixedCount, 1, &view});
    }
}

/// `toml` with the first `from` replaced by `to`.
inline std::string with(std::string toml, const std::string& from, const std::string& to) {
    return toml.replace(toml.find(from), from.size(), to);
}

}  // namespace dustbench::particles::test
