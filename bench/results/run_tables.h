// A folder with only the tables of a result: summary.csv, machine.csv and runs.csv, without `runs`.
//
// Such runs have cells and parameters; from the single row of machine.csv the machine, driver and build; from runs.csv
// the settings, hashes and warnings. They have no frames or pictures. With machine.csv and runs.csv they can be
// compared between machines.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "bench/results/stored_run.h"

namespace dustbench::results {

/// True if the folder contains a summary.csv and no folder `runs`.
[[nodiscard]] bool holdsTablesAlone(const std::filesystem::path& folder);

/// Skips damaged rows and adds a sentence for each to `problems`. Throws InputError if a table cannot be read.
[[nodiscard]] StoredRuns readSummaryRuns(const std::filesystem::path& folder, std::vector<std::string>& problems);

/// machine.csv: a header and one row, of the run that started first among those that are done. Throws InputError
/// without one.
[[nodiscard]] std::string machineCsv(const StoredRuns& runs);

/// runs.csv: a header, and a row for each run: `run_id`, `key`, `state_hash`, `method_hash`, `warnings`, one in a line
/// each.
[[nodiscard]] std::string runsCsv(const StoredRuns& runs);

/// Adds what `folder`/runs.csv says of these runs; nothing without this file. Damage is a sentence in `problems`.
void addRunTable(const std::filesystem::path& folder, StoredRuns& runs, std::vector<std::string>& problems);

}  // namespace dustbench::results
