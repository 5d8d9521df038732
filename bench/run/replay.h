// Goes through a run's steps again without its measurement: at each frame, world and method have gone through the very
// steps that they go through in `measureRun`.
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
    /// After each step, the untimed ones before frame 0 included; false: stop.
    std::function<bool()> stepped;
    /// After each frame from 0 on.
    std::function<void(std::int64_t frame)> visit;
    /// As RunProgress.
    std::function<void(std::string_view phase, std::int64_t done, std::int64_t total)> progress;
};

/// False where `stepped` stopped it.
bool replay(const Replay& replay);

}  // namespace dustbench::bench
