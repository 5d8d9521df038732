// Reads the runs of a results folder and leaves it as it is: no lock, nothing made, nothing removed.
#pragma once

#include <filesystem>

#include "bench/results/stored_run.h"

namespace dustbench::bench {

/// What is finished; what another program is still writing is not seen. Throws InputError with the folder or file where
/// it is no results folder, or a run in it cannot be read.
[[nodiscard]] StoredRuns readStoredRuns(const std::filesystem::path& folder);

}  // namespace dustbench::bench
