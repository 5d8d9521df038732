// Watches the GPU's clock while frames are recorded, and notes if it fell and what holds it down (by NVML).
//
// Units: MHz. Threads: one at a time.
#pragma once

#include <chrono>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "bench/measure/nvml.h"

namespace dustbench::measure {

struct GpuClockReading {
    unsigned int megahertz = 0;
    std::string throttledBy{};  ///< `power cap, heat`; empty if nothing slows the clock
};

class GpuClock {
 public:
    virtual ~GpuClock() = default;
    /// Throws std::runtime_error if the clock can no longer be read.
    [[nodiscard]] virtual GpuClockReading read() = 0;
};

/// The NVIDIA GPU named by `renderer` (GL_RENDERER). Null where NVML does not report a clock for exactly one such GPU.
[[nodiscard]] std::unique_ptr<GpuClock> gpuClock(const std::string& renderer, const std::string& library = nvmlLibrary);

class ClockWatch {
 public:
    /// `clock` may be null: nothing is reported then. Readings are at least `interval` apart.
    explicit ClockWatch(std::unique_ptr<GpuClock> clock,
                        std::chrono::milliseconds interval = std::chrono::milliseconds(250));

    /// Call between frames, outside of what is timed. If the clock can no longer be read, watching stops.
    void betweenFrames();
    /// The last reading, whatever the interval.
    void end();

    struct Range {
        unsigned int lowest, highest;
    };
    /// Empty if nothing was read.
    [[nodiscard]] std::optional<Range> range() const { return range_; }
    /// Why times are those of a slower GPU: `clock fell: the GPU's from 1800 to 900 MHz, limited by heat`; empty if
    /// the clock was steady.
    [[nodiscard]] std::string warning() const;

 private:
    void read();

    std::unique_ptr<GpuClock> clock_;
    std::chrono::milliseconds interval_;
    std::chrono::steady_clock::time_point last_;
    std::optional<Range> range_;
    Range fall_{0, 0};  ///< the largest fall: the clock after it, and the highest before
    std::string heldBy_;
};

/// The same warning for the processor, of its throttling events before and after; empty if there were none.
[[nodiscard]] std::string throttlingWarning(std::int64_t eventsBefore, std::int64_t eventsAfter);

/// Whether a run's warning is one of these.
[[nodiscard]] bool saysClockFell(std::string_view warning);

}  // namespace dustbench::measure
