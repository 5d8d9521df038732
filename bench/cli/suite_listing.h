// Describes a suite on a console: its runs and their state, its configurations, and an estimate of its duration.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "bench/cli/plan_runner.h"
#include "bench/suite/suite.h"

namespace dustbench::cli {

/// Prints every run with its state in the results folder `out`, which need not exist and is not changed: `done`,
/// `outdated`, `to do`, `damaged` and others. Returns the runs to do, which include damaged ones.
std::vector<bench::PlannedRun> printPlan(const std::vector<bench::PlannedRun>& plan, int repetitions,
                                         const std::filesystem::path& out);

/// Starts a run of each configuration in `toDo` and prints how long all runs will take. Returns an exit code. Throws
/// InputError if OpenGL is not available.
[[nodiscard]] int printEstimate(const std::vector<bench::PlannedRun>& toDo, PlanOptions options);

/// Describes one suite for `list suites ID`: file, varied parameters, full and quick run, comparisons.
[[nodiscard]] std::string describeSuite(const std::string& id);

}  // namespace dustbench::cli
