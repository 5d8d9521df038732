// Measures the methods in the window by the protocol of `compare`: A against B, or A alone, every run in its own
// process.
//
// Threads: call from the main thread.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "bench/run/executor.h"
#include "bench/suite/suite.h"
#include "bench/view/view_state.h"

namespace dustbench::view {

/// Minimum number of recorded frames: the run of a state at an earlier frame continues to here.
inline constexpr std::int64_t minimumMeasuredFrames = 120;
inline constexpr int measuredRepetitions = 6;

/// Plans runs of the state's halves up to its frame or further, with the null method in the same world. B is compared
/// with A; a ground truth as B is left out. Throws InputError as runOf does, and if A and B are the same run.
[[nodiscard]] suite::Suite measurementOf(const ViewState& state);

struct MeasurementHooks {
    run::ExecutionOptions execution;  ///< how runs are started; its `interrupted` is replaced
    /// Called before each run, while nothing is timed; may draw.
    std::function<void(const std::string& progress)> between;
    /// Called several times a second while a run may be timed, so it must be cheap. Returns true to cancel.
    std::function<bool()> cancelled;
};

/// Executes the suite in `folder`, replacing older results of the same runs. Returns times and verdicts as sentences,
/// or one sentence if it was cancelled. Throws InputError as `execute` does.
[[nodiscard]] std::vector<std::string> measure(const suite::Suite& suite, const std::filesystem::path& folder,
                                               const MeasurementHooks& hooks);

}  // namespace dustbench::view
