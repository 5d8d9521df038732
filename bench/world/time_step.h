// The fixed time step of every simulation.
#pragma once

namespace dustbench::world {

inline constexpr double stepSeconds = 1.0 / 60;

}  // namespace dustbench::world
