// Reads the runs of a results folder without changing it: takes no lock, creates and removes nothing.
#pragma once

#include <filesystem>

#include "bench/results/stored_run.h"

namespace dustbench::bench {

/// Reads the run of one folder. Throws InputError with its file if it cannot be read, is not the run that the folder is
/// named after, or if one of its outputs was altered.
[[nodiscard]] StoredRun readRunFolder(const std::filesystem::path& folder);

/// The number of runs that are done but did not record their outputs, as a sentence; empty if there are none.
[[nodiscard]] std::string saysNothingOfOutputs(const StoredRuns& runs);

/// Reads completed runs only; ignores runs that another program is still writing, and stray files. Throws InputError
/// with the folder or file if it is not a results folder, or if a run in it cannot be read.
[[nodiscard]] StoredRuns readStoredRuns(const std::filesystem::path& folder);

}  // namespace dustbench::bench
