// Reads the runs of a results folder without changing it: no lock, nothing created, nothing removed.
#pragma once

#include <filesystem>

#include "bench/results/stored_run.h"

namespace dustbench::bench {

/// The run of one folder. Throws InputError with its file if it cannot be read, is not the run that the folder is named
/// after, or one of its outputs is not as it was written.
[[nodiscard]] StoredRun readRunFolder(const std::filesystem::path& folder);

/// How many runs that are done say nothing of their outputs, as a sentence; empty if there are none.
[[nodiscard]] std::string saysNothingOfOutputs(const StoredRuns& runs);

/// Reads completed runs only, not those that another program is still writing, nor stray files. Throws InputError with
/// the folder or file if it is not a results folder, or a run in it cannot be read.
[[nodiscard]] StoredRuns readStoredRuns(const std::filesystem::path& folder);

}  // namespace dustbench::bench
