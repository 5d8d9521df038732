// What the experiments of methods (methods/contract/experiment.h) found, as experiments.csv keeps it.
//
// reports/SCHEMA.md has its columns.
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

/// Throws InputError for a name that is unknown, and where an experiment needs OpenGL and there is none.
[[nodiscard]] std::vector<StoredFinding> runExperiment(std::string_view name, std::uint64_t seed = 1);

[[nodiscard]] std::string findingsCsv(const std::vector<StoredFinding>& findings);
/// Of a results folder; none where it has no experiments.csv. Throws InputError where it cannot be read.
[[nodiscard]] std::vector<StoredFinding> readFindings(const std::filesystem::path& folder);

}  // namespace dustbench::bench
