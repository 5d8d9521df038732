// Runs from a folder's tables alone, summary.csv and machine.csv: what is left of results whose `runs` were not kept.
//
// They have cells, parameters and, of machine.csv's one row, the machine; no warnings, hashes, frames or pictures.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "bench/results/stored_run.h"

namespace dustbench::bench {

/// True if the folder has a summary.csv and no folder `runs`.
[[nodiscard]] bool holdsTablesAlone(const std::filesystem::path& folder);

/// Rows that are damaged are left out, each with a sentence in `problems`. Throws InputError if a table cannot be read.
[[nodiscard]] StoredRuns readSummaryRuns(const std::filesystem::path& folder, std::vector<std::string>& problems);

}  // namespace dustbench::bench
