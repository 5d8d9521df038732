// GPU time of a stretch of work, asked for now and read later so that nothing waits.
//
// Some drivers answer with nonsense (llvmpipe: 0.02 ms for 59); `timerQueriesAreTrue` finds out.
#pragma once

#include <optional>

#include "methods/kit/gpu/device.h"
#include "methods/kit/gpu/name.h"

namespace dustbench::gpu {

class DUSTBENCH_API TimerQuery {
 public:
    TimerQuery() = default;
    explicit TimerQuery(Device& device);

    void begin();
    void end();
    /// Empty while the GPU is not done yet.
    [[nodiscard]] std::optional<double> milliseconds() const;

 private:
    Name name_;
};

/// Draws a known load and compares the query with fenced wall time: true where they agree within a factor of two.
[[nodiscard]] DUSTBENCH_API bool timerQueriesAreTrue(Device& device);

}  // namespace dustbench::gpu
