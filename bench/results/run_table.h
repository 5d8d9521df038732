// runs.csv: the settings, hashes and warnings of runs, which summary.csv does not hold. With it, folders of tables
// alone (summary_runs.h) can be compared between machines, and keep the warnings of their runs.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "bench/results/stored_run.h"

namespace dustbench::bench {

/// A header, and a row for each run: `run_id`, `key`, `state_hash`, `method_hash`, `warnings`, one in a line each.
[[nodiscard]] std::string runsCsv(const StoredRuns& runs);

/// Adds what `folder`/runs.csv says of these runs; nothing without this file. Damage is a sentence in `problems`.
void addRunTable(const std::filesystem::path& folder, StoredRuns& runs, std::vector<std::string>& problems);

}  // namespace dustbench::bench
