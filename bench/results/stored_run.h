// The contents of a run.json that are needed to resume, summarise, compare and display runs.
//
// Threads: any.
#pragma once

#include <filesystem>
#include <map>
#include <optional>
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
    std::string stateHash{}, methodHash{};  ///< empty if the run did not get that far, or has none
    /// By field: `cpu`, `build_type`, `key` …, without the inputs.
    std::map<std::string, std::string, std::less<>> provenance{};
    std::vector<InputHash> inputs{};
    std::vector<InputHash> searches{};    ///< none in results of older builds
    std::vector<IgnoredParts> ignored{};  ///< likewise
    /// Empty in results of older builds, which recorded none: whether their files were altered cannot be told.
    std::optional<std::vector<OutputFile>> outputs{};
};

/// Why no claim, fit, verdict or gate may use the run (`invalid` of summary.csv); empty if it is valid.
[[nodiscard]] std::string whyInvalid(const StoredRun& run);

/// How many of these runs are invalid and why, as one line; empty if all are valid.
[[nodiscard]] std::string saysInvalid(const std::vector<const StoredRun*>& runs);

/// By run id.
using StoredRuns = std::map<std::string, StoredRun>;

/// Throws InputError with the file if it is not a valid run.json, or one of its columns of numbers holds something
/// else; repetitions are 1..files::limits::repetitions. Reasons and warnings end after 1,000 bytes.
[[nodiscard]] StoredRun readRunFile(const std::filesystem::path& file);

/// What readers of a run's cells rely on: numbers are numbers, and repetitions can be counted through. Throws
/// InputError.
void requireSoundCells(const StoredRun& run);

}  // namespace dustbench::bench
