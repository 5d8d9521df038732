// The clock used for all measurements, and the cost of reading it.
//
// Threads: pure, except for the clock itself.
#pragma once

#include <cstdint>

namespace dustbench::bench {

/// Nanoseconds of a steady clock, unaffected by changes to the time of day.
[[nodiscard]] std::int64_t steadyNow();

/// Age of this process, in steps of the kernel's clock tick (10 ms). Throws std::runtime_error if the kernel does not
/// report it.
[[nodiscard]] double secondsSinceProcessStart();

/// Overhead of measuring on this machine: the median of several rounds.
struct ClockCost {
    double readingNs = 0;  ///< one read of the clock
    double stageNs = 0;    ///< one stage: its begin and end, without a fence
};
[[nodiscard]] ClockCost measureClockCost();

}  // namespace dustbench::bench
