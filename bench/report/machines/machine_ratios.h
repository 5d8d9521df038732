// Ratios of the methods' times on each machine, and the times themselves, experiment by experiment.
//
// A ratio compares two variants, methods with their own settings, within one machine: run with run of the same world,
// seed and repetition (pairKey of method_time.h). Its interval and verdict are those of paired_ratio.h, over the
// repetitions; where all machines share several seeds, over the seeds, each the mean of its repetitions. Seeds that not
// all machines have are left out. For all worlds together, each repetition or seed gives one ratio, the geometric mean
// over the worlds that every machine has which has the two at all: so all machines answer the same question.
//
// Units: ms, and frames per second. Threads: plain data.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "bench/measure/paired_ratio.h"
#include "bench/report/machines/machine_cells.h"
#include "bench/report/median_interval.h"

namespace dustbench::bench {

/// What varies between the worlds of an experiment.
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
    PairedRatio result;
    std::string reason;  ///< why there is not enough data for a verdict; else empty
};

struct RatioRow {
    std::size_t world = 0;         ///< of MachineExperiment::worlds; of no meaning for all together
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

/// What one machine measured, not to be compared with that of another without saying so.
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
    /// The variant that the others are shown against: the one with most ratios, of equals the first.
    std::size_t reference = 0;
};

/// `particles=500 speed=20`
[[nodiscard]] std::string worldLabel(const MachineExperiment& experiment, std::size_t world);

/// `with` over `of`.
[[nodiscard]] PairedRatio inverted(const PairedRatio& ratio);

/// Of cells that are the same work everywhere. Experiments without a run are left out.
[[nodiscard]] std::vector<MachineExperiment> compareMachines(const MachineSet& set, const MachineCells& cells);

}  // namespace dustbench::bench
