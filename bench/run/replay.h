// Repeats the steps of a run without measuring: at each frame, world and method have made exactly the same steps as in
// `measureRun`.
#pragma once

#include <cstdint>
#include <functional>
#include <string_view>

#include "bench/run/frame_runner.h"

namespace dustbench::bench {

struct Replay {
    const RunSpec& spec;
    FrameRunner& runner;
    std::int64_t prerollSteps;  ///< stepsBeforeWarmup
    std::int64_t lastFrame;
    /// Called after each step, including the untimed ones before frame 0; returning false stops the replay.
    std::function<bool()> stepped;
    /// Called after each frame from 0 on.
    std::function<void(std::int64_t frame)> visit;
    /// As RunProgress.
    std::function<void(std::string_view phase, std::int64_t done, std::int64_t total)> progress;
};

/// Returns false if `stepped` stopped it.
bool replay(const Replay& replay);

}  // namespace dustbench::bench
