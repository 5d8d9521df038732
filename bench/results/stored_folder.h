// Reads the runs of a results folder without changing it: no lock, nothing created, nothing removed.
#pragma once

#include <filesystem>

#include "bench/results/stored_run.h"

namespace dustbench::bench {

/// Reads completed runs only, not those that another program is still writing. Throws InputError with the folder or
/// file if it is not a results folder, or a run in it cannot be read.
[[nodiscard]] StoredRuns readStoredRuns(const std::filesystem::path& folder);

}  // namespace dustbench::bench
