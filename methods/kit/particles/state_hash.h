// The hash of a particle simulation: time, vehicle, moving solids and systems. The world and methods use the same
// function, so equal hashes mean equal states.
//
// Threads: pure.
#pragma once

#include <cstdint>
#include <span>

#include "methods/contract/scene.h"

namespace dustbench::particles {

/// `systems`: ParticleSystem::stateHash of each, in their order.
[[nodiscard]] DUSTBENCH_API std::uint64_t stateHash(const scene::SceneState& state,
                                                    std::span<const std::uint64_t> systems);

}  // namespace dustbench::particles
