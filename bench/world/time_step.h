// The fixed time step of every simulation.
#pragma once

namespace dustbench::bench {

inline constexpr double stepSeconds = 1.0 / 60;

}  // namespace dustbench::bench
