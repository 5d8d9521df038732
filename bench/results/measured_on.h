// Compares the circumstances of two runs (machine, graphics device, build), and detects copies of one measurement.
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

}  // namespace dustbench::bench
