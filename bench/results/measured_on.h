// Compares the circumstances of two runs: machine, graphics device and build; or whether they are one.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "bench/results/stored_run.h"

namespace dustbench::bench {

/// Provenance fields in run.json that must be equal for times to be comparable.
[[nodiscard]] std::span<const std::string_view> machineFields();
/// Fields that may differ on purpose but should be reported: `compiler`, `gl_version` …
[[nodiscard]] std::span<const std::string_view> circumstanceFields();

/// The run's values of these fields; empty where it has none.
[[nodiscard]] std::vector<std::string> valuesOf(const StoredRun& run, std::span<const std::string_view> fields);

/// The first input file that is not the same in both; empty if all are.
[[nodiscard]] std::string differingInput(const StoredRun& first, const StoredRun& second);

/// True if both are one measurement, as in a folder and its copy: same start, place, numbers and files.
[[nodiscard]] bool areOneMeasurement(const StoredRun& a, const StoredRun& b);

struct FieldDifference {
    std::string field, first, second;
};
[[nodiscard]] std::vector<FieldDifference> differences(const StoredRun& first, const StoredRun& second,
                                                       std::span<const std::string_view> fields);

}  // namespace dustbench::bench
