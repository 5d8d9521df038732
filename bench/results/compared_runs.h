// Which stored runs can be compared: the settings that distinguish them (their key), the circumstances in which they
// were measured (machine, graphics device, build), and a method's own time, the difference of two such runs.
//
// Units: ms.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "bench/results/run_spec.h"
#include "bench/results/stored_run.h"
#include "methods/contract/method.h"

namespace dustbench::results {

/// Names and values in the order of canonicalKey (run_spec.h): `method`, `scene`, `drive`, `p.particles`, `frames` …
using KeyFields = std::vector<std::pair<std::string, std::string>>;

/// Throws InputError with the run if its provenance has no key, or if a line of the key is not `name=value`.
[[nodiscard]] KeyFields keyFields(const StoredRun& run);

/// The specification of the run, without volumes and metrics. Throws InputError as keyFields does, and for an invalid
/// value.
[[nodiscard]] RunSpec specFromKey(const StoredRun& run);

// --- Circumstances of two runs

/// Provenance fields in run.json that must be equal for times to be comparable.
[[nodiscard]] std::span<const std::string_view> machineFields();
/// Fields that may differ on purpose but should be reported: `compiler`, `gl_version` …
[[nodiscard]] std::span<const std::string_view> circumstanceFields();

/// The run's values of these fields; empty for fields that it does not have.
[[nodiscard]] std::vector<std::string> valuesOf(const StoredRun& run, std::span<const std::string_view> fields);

/// The first input file that differs between the runs; empty if none does.
[[nodiscard]] std::string differingInput(const StoredRun& first, const StoredRun& second);

/// True if both are the same measurement, as in a folder and its copy: same start, place, numbers and files.
[[nodiscard]] bool areOneMeasurement(const StoredRun& a, const StoredRun& b);

struct FieldDifference {
    std::string field, first, second;
};
[[nodiscard]] std::vector<FieldDifference> differences(const StoredRun& first, const StoredRun& second,
                                                       std::span<const std::string_view> fields);

// --- A method's own time: its frame time minus that of the null method in the same world

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

}  // namespace dustbench::results
