// Ratios of the methods' times on each machine, and the times themselves, for each experiment.
//
// A ratio compares two variants, which are methods with their own settings, within one machine. It pairs runs of the
// same world, seed and repetition (pairKey of compared_runs.h). Interval and verdict are those of statistics.h over the
// repetitions or, if all machines share several seeds, over the seeds, with the mean over each seed's repetitions.
// Seeds that are missing on a machine are left out. For all worlds together, each repetition or seed gives one ratio:
// the geometric mean over the worlds that were measured on every machine that has both variants. So all machines answer
// the same question.
//
// Units: ms, and frames per second. Threads: plain data.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "bench/measure/statistics.h"
#include "bench/report/machines/machine_set.h"
#include "bench/report/median_interval.h"

namespace dustbench::report {

/// A setting that varies between the worlds of an experiment.
struct WorldAxis {
    std::string name;  ///< `particles`, `size`
    std::string unit;
    bool numeric = false;             ///< every value is a number
    std::vector<std::string> values;  ///< ascending
};

struct MachineVariant {
    std::string method;
    std::string label;  ///< `octree_search depth=8`
};

/// A ratio on one machine.
struct SideRatio {
    measure::PairedRatio result;
    std::string reason;  ///< why there is not enough data for a verdict; otherwise empty
};

struct RatioRow {
    std::size_t world = 0;         ///< index in MachineExperiment::worlds; unused for all worlds together
    std::vector<SideRatio> sides;  ///< by MachineSet::sides
};

/// The time of `of` over that of `with`, both of MachineExperiment::variants.
struct MachineRatio {
    std::size_t of = 0, with = 0;
    std::string column;  ///< of summary.csv
    std::vector<RatioRow> worlds;
    RatioRow all;
    std::size_t common = 0;  ///< number of worlds in `all`
};

/// A time measured on one machine. Any comparison with another machine's must be marked as such.
struct MachineValue {
    std::size_t variant = 0, world = 0, side = 0;
    std::string column;
    MedianInterval value;  ///< over the repetitions, or over the medians of several seeds
    bool overSeeds = false;
};

struct MachineExperiment {
    std::string id{}, title{}, summary{};  ///< of the suite; or `other`
    std::vector<WorldAxis> axes{};
    std::vector<MachineVariant> variants{};          ///< sorted by label
    std::vector<std::vector<std::string>> worlds{};  ///< a value for each axis; empty: the world has no such setting
    std::vector<MachineRatio> ratios{};              ///< of < with; those that some machine has
    std::vector<MachineValue> values{};
    /// The variant with which the others are compared: the first one with the most ratios.
    std::size_t reference = 0;
};

/// `particles=500 speed=20`
[[nodiscard]] std::string worldLabel(const MachineExperiment& experiment, std::size_t world);

/// `with` over `of`.
[[nodiscard]] measure::PairedRatio inverted(const measure::PairedRatio& ratio);

/// Uses only cells whose work is the same everywhere. Experiments without a run are left out.
[[nodiscard]] std::vector<MachineExperiment> compareMachines(const MachineSet& set, const MachineCells& cells);

}  // namespace dustbench::report
