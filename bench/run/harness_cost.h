// What the harness itself takes: measured with the null method, as every run is measured.
#pragma once

#include <functional>
#include <string>

#include "bench/run/executor.h"

namespace dustbench::bench {

struct HarnessCost {
    double harnessUs = 0;     ///< of a frame, in no stage
    double startSeconds = 0;  ///< from a process's start to its first timed frame, without preroll
    double frameMs = 0;       ///< of a frame without a method, 640x480
};

/// Runs the null method in a temporary folder, one process; about two seconds. Throws InputError where this build has
/// no such method or the run does not end well, with its reason.
[[nodiscard]] HarnessCost measureHarness(ExecutionOptions options);

}  // namespace dustbench::bench
