// Reads runs from the tables summary.csv and machine.csv of a folder whose `runs` were not kept.
//
// Such runs have cells, parameters and, from the single row of machine.csv, the machine; but no warnings, hashes,
// frames or pictures.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "bench/results/stored_run.h"

namespace dustbench::bench {

/// True if the folder contains a summary.csv and no folder `runs`.
[[nodiscard]] bool holdsTablesAlone(const std::filesystem::path& folder);

/// Skips damaged rows and adds a sentence for each to `problems`. Throws InputError if a table cannot be read.
[[nodiscard]] StoredRuns readSummaryRuns(const std::filesystem::path& folder, std::vector<std::string>& problems);

}  // namespace dustbench::bench
