// The contents of a run.json, as needed to resume, summarise, compare and display runs, and the runs of a results
// folder, which is read without changing it: takes no lock, creates and removes nothing.
//
// Threads: any.
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "bench/results/run_record.h"

namespace dustbench::results {

struct StoredRun {
    std::string runId;
    RunStatus status = RunStatus::done;
    std::string reason;
    ParameterTexts parameters;
    std::map<std::string, std::string, std::less<>> cells;  ///< by column of summary.csv
    std::vector<std::string> warnings{};
    std::string stateHash{}, methodHash{};  ///< empty if the run ended before, or has none
    /// By field: `cpu`, `build_type`, `key` …, without the inputs.
    std::map<std::string, std::string, std::less<>> provenance{};
    std::vector<measure::InputHash> inputs{};
    std::vector<measure::InputHash> searches{};    ///< none in results from older builds
    std::vector<measure::IgnoredParts> ignored{};  ///< none in results from older builds
    /// Empty in results from older builds, which did not record them: changes to their files cannot be detected.
    std::optional<std::vector<OutputFile>> outputs{};
};

/// Why claims, fits, verdicts and gates must not use the run (`invalid` of summary.csv); empty if it is valid.
[[nodiscard]] std::string whyInvalid(const StoredRun& run);

/// The number of invalid runs and the reasons, as one line; empty if all are valid.
[[nodiscard]] std::string saysInvalid(const std::vector<const StoredRun*>& runs);

/// By run id.
using StoredRuns = std::map<std::string, StoredRun>;

/// Throws InputError with the file if it is not a valid run.json, or if a numeric column contains something else;
/// repetitions are 1..files::limits::repetitions. Reasons and warnings are cut after 1,000 bytes.
[[nodiscard]] StoredRun readRunFile(const std::filesystem::path& file);

/// Checks what readers of a run's cells rely on: numeric columns contain numbers, and the repetition is within its
/// limits. Throws InputError.
void requireSoundCells(const StoredRun& run);

/// Reads the run of one folder. Throws InputError with its file if it cannot be read, is not the run that the folder is
/// named after, or if one of its outputs was altered.
[[nodiscard]] StoredRun readRunFolder(const std::filesystem::path& folder);

/// The number of runs that are done but did not record their outputs, as a sentence; empty if there are none.
[[nodiscard]] std::string saysNothingOfOutputs(const StoredRuns& runs);

/// Reads completed runs only; ignores runs that another program is still writing, and stray files. Throws InputError
/// with the folder or file if it is not a results folder, or if a run in it cannot be read.
[[nodiscard]] StoredRuns readStoredRuns(const std::filesystem::path& folder);

}  // namespace dustbench::results
