// One time step as seen by the parts: the world, its length, and the birthplaces that move through it, such as wheels.
//
// Units: m, m/s, s. Frame: world. Owns: nothing, and is valid during one update, but for the tracker.
#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <span>

#include "methods/contract/scene.h"
#include "methods/contract/view.h"

namespace dustbench::particles {

struct Lattice;

/// A possible birthplace: a point that moves along a line during the step, with axes.
struct Emitter {
    glm::vec3 from{0}, to{0};                  ///< at the start and the end of the step
    glm::vec3 velocityFrom{0}, velocityTo{0};  ///< velocity of the carrier
    glm::vec3 forward{1, 0, 0}, up{0, 1, 0}, right{0, 0, 1};
    float speed = 0;      ///< along `forward`, m/s
    glm::vec3 thrown{0};  ///< added to the velocity of every newborn: that of an event

    /// From the emitter's frame (forward, up, right) to the world.
    [[nodiscard]] glm::vec3 toWorld(const glm::vec3& local) const {
        return local.x * forward + local.y * up + local.z * right;
    }
};

struct Step {
    const scene::Scene& scene;
    const scene::SceneState& state;
    double seconds;
    std::uint64_t seed;
    double fixedRatePerSecond;          ///< above 0: births per second, overriding the emission's rate
    std::span<const Emitter> wheels;    ///< empty without a vehicle
    std::int64_t particlesPerPuff = 1;  ///< factor on the number of births, at any rate
    const Lattice* lattice = nullptr;   ///< that the particles form; null: none
    const scene::View* view = nullptr;  ///< of the camera; null: none
};

/// Each use of random numbers has its own stream, so that swapping one part leaves the other parts' numbers unchanged.
enum RandomStream : std::uint32_t {
    positionStream = 1,
    velocityStream,
    lifeStream,
    sizeStream,
    colourStream,
    windStream,
    eventStream
};

/// Tracks the vehicle's wheels between steps, so that births can be spread along their paths.
class DUSTBENCH_API EmitterTracker {
 public:
    /// The wheels' paths through a step that ends in `state`; empty without a vehicle. The first path is extrapolated
    /// from the wheels' velocities.
    [[nodiscard]] std::span<const Emitter> follow(const scene::Scene& scene, const scene::SceneState& state,
                                                  double seconds);

 private:
    std::array<Emitter, 4> wheels_;
    bool known_ = false;  ///< wheels_ is the end of the previous step
};

}  // namespace dustbench::particles
