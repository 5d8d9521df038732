// What a run.json says, as far as resuming, summary.csv, comparisons and people at the console need it.
//
// Threads: any.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "bench/results/run_record.h"

namespace dustbench::bench {

struct StoredRun {
    std::string runId;
    RunStatus status = RunStatus::done;
    std::string reason;
    ParameterTexts parameters;
    std::map<std::string, std::string, std::less<>> cells;  ///< by column of summary.csv
    std::vector<std::string> warnings{};
    std::string stateHash{}, methodHash{};  ///< empty where the run did not get there, or has none
    /// By field: `cpu`, `build_type`, `key` …, but for the inputs.
    std::map<std::string, std::string, std::less<>> provenance{};
    std::vector<InputHash> inputs{};
};

/// By run id.
using StoredRuns = std::map<std::string, StoredRun>;

/// Throws InputError with the file where it is no such thing.
[[nodiscard]] StoredRun readRunFile(const std::filesystem::path& file);

}  // namespace dustbench::bench
