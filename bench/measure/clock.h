// The clock that everything is measured by, and what looking at it costs.
//
// Threads: pure, but for the clock itself.
#pragma once

#include <cstdint>

namespace dustbench::bench {

/// Nanoseconds of a steady clock: never set back, whatever happens to the time of day.
[[nodiscard]] std::int64_t steadyNow();

/// Since this process began, in steps of the kernel's clock tick (10 ms). Throws std::runtime_error where the kernel
/// does not tell.
[[nodiscard]] double secondsSinceProcessStart();

/// What measuring costs here and now, median of several rounds.
struct ClockCost {
    double readingNs = 0;  ///< one look at the clock
    double stageNs = 0;    ///< one stage: its beginning and its end, without a fence
};
[[nodiscard]] ClockCost measureClockCost();

}  // namespace dustbench::bench
