// The configurations (cells) of a suite: what varies between them (the world, which all methods share, and settings of
// methods), their stored runs, and the numbers in these.
#pragma once

#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "bench/results/stored_run.h"
#include "bench/suite/suite.h"

namespace dustbench::suite {

struct Axis {
    std::string name;
    std::function<std::string(const results::RunSpec&)> of;
};

/// Those of scene, drive, size and the world's parameters that vary between configurations.
[[nodiscard]] std::vector<Axis> worldAxes(std::span<const PlannedRun* const> cells);

/// Method parameters that vary between configurations of one method. Parameters that only differ between methods are
/// part of the suite's setup.
[[nodiscard]] std::vector<Axis> methodAxes(std::span<const PlannedRun* const> cells);

/// `particles=500 speed=20`; empty values are omitted.
[[nodiscard]] std::string labelOf(const std::vector<Axis>& axes, const results::RunSpec& spec);

/// Scene, drive, size, seed and the world's parameters: equal for runs in the same world.
[[nodiscard]] std::string worldKey(const results::RunSpec& spec);

[[nodiscard]] bool isOfTheWorld(std::string_view parameter);

[[nodiscard]] std::vector<const PlannedRun*> cellsOf(const Suite& suite);

/// The run of this repetition (from 1) if it is done, else null.
[[nodiscard]] const results::StoredRun* doneRun(const PlannedRun& cell, int repetition,
                                                const results::StoredRuns& runs);
/// All runs of a configuration that are done, in order.
[[nodiscard]] std::vector<const results::StoredRun*> doneRuns(const PlannedRun& cell, int repetitions,
                                                              const results::StoredRuns& runs);

/// The same without invalid runs, as fits and verdicts use them.
[[nodiscard]] const results::StoredRun* validRun(const PlannedRun& cell, int repetition,
                                                 const results::StoredRuns& runs);
[[nodiscard]] std::vector<const results::StoredRun*> validOf(std::vector<const results::StoredRun*> done);

/// A value of summary.csv; empty if the run has none.
[[nodiscard]] std::optional<double> numberIn(const results::StoredRun& run, std::string_view column);
/// The values of all runs that have one.
[[nodiscard]] std::vector<double> numbersIn(const std::vector<const results::StoredRun*>& runs,
                                            std::string_view column);

}  // namespace dustbench::suite
