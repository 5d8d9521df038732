// What `dustbench measure-machine` measures: suites with the load of each, and limits of time and memory, from
// `data/machines/measure-machine.toml`, which documents its keys.
//
// Units: seconds, bytes. Threads: plain data.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "bench/results/stored_run.h"
#include "bench/suite/machine/load_ladder.h"
#include "bench/suite/suite.h"

namespace dustbench::suite {

struct MachineSuite {
    Suite suite;
    std::string load;  ///< the parameter that grows; empty: only the size does
};

struct MachinePlan {
    std::vector<MachineSuite> suites;
    LadderLimits hardware, software;  ///< times for a GPU, and for a software renderer; memory is not limited
    double memoryShare = 1;           ///< of the memory that is free at the start, for one run
};

/// Throws InputError with file and line.
[[nodiscard]] MachinePlan loadMachinePlan(bool quick);

/// The file itself, and those of its suites. Throws InputError.
[[nodiscard]] std::vector<std::filesystem::path> machinePlanFiles();

/// A cell with its place on a ladder; the null method's cells are among them (withBaselines). Each run once.
struct PlacedCell {
    PlannedRun run;
    LadderCell ladder;
};
[[nodiscard]] std::vector<PlacedCell> cellsOf(const MachinePlan& plan);

/// The load that a parameter's value stands for: a number, or the number of cells of `128x64x64`. Throws InputError.
[[nodiscard]] double loadOf(const std::string& value);

/// What a run that is done took.
[[nodiscard]] RunNeeds needsOf(const results::StoredRun& run, const results::RunSpec& spec);

}  // namespace dustbench::suite
