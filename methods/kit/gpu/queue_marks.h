// Marks in the GPU's command queue: fences that the CPU can wait for, and timers of the commands between two marks.
//
// Some drivers report wrong times (llvmpipe: 0.02 ms instead of 59); `timerQueriesAreTrue` detects them.
#pragma once

#include <optional>

#include "methods/kit/gpu/device.h"
#include "methods/kit/gpu/ownership.h"

namespace dustbench::gpu {

class DUSTBENCH_API Fence {
 public:
    Fence() = default;
    /// A marker after all work queued so far.
    [[nodiscard]] static Fence afterQueuedWork();
    ~Fence();
    Fence(Fence&& other) noexcept;
    Fence& operator=(Fence&& other) noexcept;

    /// Blocks until the work before the marker is done; returns at once if there is no marker.
    void wait();

 private:
    void* sync_ = nullptr;
};

/// Measures GPU time of a section of commands; results are read later, so that nothing waits.
class DUSTBENCH_API TimerQuery {
 public:
    TimerQuery() = default;
    explicit TimerQuery(Device& device);

    void begin();
    void end();
    /// Empty until the GPU has finished.
    [[nodiscard]] std::optional<double> milliseconds() const;

 private:
    Name name_;
};

/// A known load by both clocks.
struct TimerComparison {
    double queryMs = 0, fenceMs = 0;
    /// Within a factor of two.
    [[nodiscard]] bool agree() const { return queryMs > fenceMs / 2 && queryMs < fenceMs * 2; }
};
[[nodiscard]] DUSTBENCH_API TimerComparison compareTimerWithFence(Device& device);
/// Whether they agree.
[[nodiscard]] DUSTBENCH_API bool timerQueriesAreTrue(Device& device);

}  // namespace dustbench::gpu
