// A list of runs from a TOML file: methods × scenes × drives × sizes × parameter values × repetitions.
//
// `data/suites/` and `data/papers/<id>/suites/` hold them; data/suites/README.md names every key.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "bench/results/run_spec.h"
#include "bench/suite/planned_evaluation.h"

namespace dustbench::bench {

struct PlannedRun {
    RunSpec spec;
    std::string label;    ///< the parameters that the suite sets: `particles=1000 speed=20`
    int repetitions = 0;  ///< of a cell that has fewer than its suite; 0: as many
};

/// interleaved: every repetition is a round over all cells, each round in its own seeded random order: groups of cells
/// (cell_groups.h), and the cells of each group one after the other, so that a drift of the machine hits alike what is
/// compared. batch: all repetitions of a cell, then the next cell.
enum class Order { interleaved, batch };
inline constexpr Choices<Order> orders{{"interleaved", Order::interleaved}, {"batch", Order::batch}};

struct Suite {
    std::string id;
    std::string title;
    std::string summary;
    std::vector<PlannedRun> cells;  ///< one repetition each
    int repetitions = 1;
    Order order = Order::interleaved;
    double timeoutSeconds = 600;  ///< of one run
    double cooldownSeconds = 0;   ///< of rest between two runs
    std::vector<PlannedComparison> comparisons;
    std::vector<PlannedFit> fits;
};

/// The id of a suite, or its file. Paths within a suite's file are relative to it. `quick` takes the file's `[quick]`
/// values. Throws InputError with file, line and what was expected.
[[nodiscard]] Suite loadSuite(const std::string& idOrFile, bool quick);
[[nodiscard]] Suite parseSuite(std::string_view text, const std::string& name, bool quick);

/// A cell's run, from 1. Metrics belong to the first: pictures do not depend on the repetition.
[[nodiscard]] RunSpec inRepetition(RunSpec cell, int repetition);
[[nodiscard]] std::vector<PlannedRun> planRuns(const Suite& suite);

/// One value list a parameter, in order.
using ParameterLists = std::vector<std::pair<std::string, std::vector<std::string>>>;
/// All combinations, the last parameter changing fastest: `base` with each of them set and labelled.
[[nodiscard]] std::vector<PlannedRun> expandParameters(const RunSpec& base, const MethodInfo& method,
                                                       const ParameterLists& lists);

struct SuiteFile {
    std::string id;
    std::filesystem::path file;
    std::string paper;  ///< empty for our own
};
/// Every suite of the folders of data, sorted by id.
[[nodiscard]] std::vector<SuiteFile> listSuites();

}  // namespace dustbench::bench
