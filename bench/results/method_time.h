// A method's own time: what its frames take beyond those of the null method in the same world.
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

/// What runs of different methods share that are compared run by run: of a run's key all but the method, the methods'
/// own parameters, and what is done outside of timed frames. Seed and repetition are among it.
/// Empty for a run without a readable key: it has no pair.
[[nodiscard]] std::optional<KeyFields> pairKey(const StoredRun& run);

/// Sets `method_ms_median` of every done run: its `frame_ms_median` less that of the null method, at its defaults, in
/// the same world with the same frames, warm-up, threads, sync and repetition, on the same machine. Without such a run,
/// and for the null method's own, it is empty.
void addMethodTimes(StoredRuns& runs);

}  // namespace dustbench::bench
