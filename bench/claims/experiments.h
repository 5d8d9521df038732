// Findings of the methods' experiments (methods/contract/experiment.h), as stored in experiments.csv.
//
// reports/SCHEMA.md defines its columns.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "methods/contract/experiment.h"

namespace dustbench::bench {

struct StoredFinding : Finding {
    std::string experiment;
};

[[nodiscard]] std::vector<std::string> experimentNames();

/// Throws InputError for an unknown name, or if an experiment needs OpenGL and it is not available.
[[nodiscard]] std::vector<StoredFinding> runExperiment(std::string_view name, bool quick = false,
                                                       std::uint64_t seed = 1);

[[nodiscard]] std::string findingsCsv(const std::vector<StoredFinding>& findings);
/// Findings of a results folder; none if it contains no experiments.csv. Throws InputError if it cannot be read.
[[nodiscard]] std::vector<StoredFinding> readFindings(const std::filesystem::path& folder);

}  // namespace dustbench::bench
