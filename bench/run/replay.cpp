#include "bench/run/replay.h"

#include <algorithm>

namespace dustbench::bench {

bool replay(const Replay& replay) {
    for (std::int64_t step = 0; step < replay.prerollSteps; ++step) {
        replay.progress("preroll", step, replay.prerollSteps);
        const std::int64_t index = step - replay.prerollSteps - replay.spec.warmup;
        step + 1 < replay.prerollSteps ? replay.runner.stepWithoutPicture(index) : replay.runner.updateOnly(index);
        if (!replay.stepped()) return false;
    }
    for (std::int64_t index = -replay.spec.warmup; index <= replay.lastFrame; ++index) {
        replay.progress("frames", std::max<std::int64_t>(index, 0), replay.lastFrame + 1);
        replay.runner.updateOnly(index);
        const bool goOn = replay.stepped();
        if (index >= 0) replay.visit(index);
        if (!goOn) return false;
    }
    replay.progress("frames", replay.lastFrame + 1, replay.lastFrame + 1);
    return true;
}

}  // namespace dustbench::bench
