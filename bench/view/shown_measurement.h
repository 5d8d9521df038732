// Measures what the window shows by the protocol of `compare`: A against B, or A alone, every run in a process of its
// own.
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

namespace dustbench::bench {

/// Fewest recorded frames of a measured run: that of a state at an earlier frame goes on to here.
inline constexpr std::int64_t minimumMeasuredFrames = 120;
inline constexpr int measuredRepetitions = 6;

/// The runs of the state's halves, up to its frame at least, with the null method in the same world; B is compared with
/// A. The exact picture is left out. Throws InputError as runOf does, and if A and B are the same run.
[[nodiscard]] Suite measurementOf(const ViewState& state);

struct MeasurementHooks {
    ExecutionOptions execution;  ///< how runs are started; its `interrupted` is replaced
    /// Before each run, while nothing is timed: the place to draw.
    std::function<void(const std::string& progress)> between;
    /// Several times a second, while a run may be timed: must do next to nothing. True: cancel.
    std::function<bool()> cancelled;
};

/// Executes the suite in `folder`, where older results of the same runs are replaced. Returns the verdicts, or for A
/// alone its times, as sentences; one that says so if it was cancelled. Throws InputError as `execute` does.
[[nodiscard]] std::vector<std::string> measure(const Suite& suite, const std::filesystem::path& folder,
                                               const MeasurementHooks& hooks);

}  // namespace dustbench::bench
