// Experiments for what papers claim and no run of a method can answer: each gives numbers with intervals.
//
// They are functions of their seed, or of nothing. `experiments.csv` holds what came out, reports/SCHEMA.md its
// columns.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace dustbench::bench {

/// A number that an experiment found, with its 95 % interval; where no chance enters, the least and the greatest of
/// what was looked at.
struct Finding {
    std::string experiment;
    std::string quantity;
    double value = 0;
    double low = 0, high = 0;
    std::int64_t samples = 0;  ///< draws, steps, pixels or births behind it
};

[[nodiscard]] const std::vector<std::string>& experimentNames();

/// Throws InputError for a name that is unknown, and for `sight` and `births` where there is no OpenGL.
[[nodiscard]] std::vector<Finding> runExperiment(std::string_view name, std::uint64_t seed = 1);

[[nodiscard]] std::string findingsCsv(const std::vector<Finding>& findings);
/// Of a results folder; none where it has no experiments.csv. Throws InputError where it cannot be read.
[[nodiscard]] std::vector<Finding> readFindings(const std::filesystem::path& folder);

}  // namespace dustbench::bench
