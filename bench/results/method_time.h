// A method's own time: its frame time minus that of the null method in the same world.
//
// Units: ms.
#pragma once

#include <optional>
#include <string_view>

#include "bench/results/key_fields.h"
#include "bench/results/stored_run.h"
#include "methods/contract/method.h"

namespace dustbench::bench {

/// The method that draws nothing: its frame is the world, the opaque scene and the harness.
inline constexpr std::string_view baselineMethod = "null_method";
/// Null if this build has none.
[[nodiscard]] const MethodInfo* findBaseline();

/// Identifies runs of different methods that are compared run by run: the run's key, including seed and repetition, but
/// without the method, method parameters and everything outside the timed frames. Empty for a run without a readable
/// key, which is never paired.
[[nodiscard]] std::optional<KeyFields> pairKey(const StoredRun& run);

/// Sets `method_ms_median` of every run that is done: its `frame_ms_median` minus that of the null method, at its
/// defaults, in the same world with the same frames, warm-up, threads, sync and repetition, on the same machine. Empty
/// without such a run, and for the null method itself.
void addMethodTimes(StoredRuns& runs);

}  // namespace dustbench::bench
