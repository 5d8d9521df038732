// What a suite consists of, for a console: its runs and their state, its form, the time it takes.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "bench/cli/plan_runner.h"
#include "bench/suite/suite.h"

namespace dustbench::cli {

/// Prints every run with its state in the results folder `out`, which need not exist and is not changed: `done`,
/// `outdated`, or `to do`, as `damaged` results are too. Returns the runs to do.
std::vector<bench::PlannedRun> printPlan(const std::vector<bench::PlannedRun>& plan, int repetitions,
                                         const std::filesystem::path& out);

/// Starts a run of each cell among `toDo`, and prints how long all of them will take. Returns an exit code. Throws
/// InputError if OpenGL is not available.
[[nodiscard]] int printEstimate(const std::vector<bench::PlannedRun>& toDo, PlanOptions options);

/// One whole suite, for `list suites ID`: file, what it varies, runs of both forms, comparisons.
[[nodiscard]] std::string describeSuite(const std::string& id);

}  // namespace dustbench::cli
