// Measures the overhead of the harness itself, with a run of the null method.
#pragma once

#include <functional>
#include <string>

#include "bench/run/executor.h"

namespace dustbench::run {

struct HarnessCost {
    double harnessUs = 0;     ///< per frame, outside all stages
    double startSeconds = 0;  ///< from process start to the first timed frame, without preroll
    double frameMs = 0;       ///< of a frame without a method, 640x480
};

/// Runs the null method in a temporary folder, in one process; takes about two seconds. Throws InputError if this build
/// does not have the method or the run fails, with the reason.
[[nodiscard]] HarnessCost measureHarness(ExecutionOptions options);

}  // namespace dustbench::run
