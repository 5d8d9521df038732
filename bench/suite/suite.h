// A list of runs from a TOML file: methods × scenes × drives × sizes × parameter values × repetitions.
//
// Suites are in `data/suites/` and `data/papers/<id>/suites/`; data/suites/README.md documents every key.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "bench/results/run_spec.h"
#include "bench/suite/planned_evaluation.h"
#include "bench/suite/resource_limits.h"

namespace dustbench::suite {

struct PlannedRun {
    results::RunSpec spec;
    std::string label;    ///< the parameters that the suite sets: `particles=1000 speed=20`
    int repetitions = 0;  ///< if fewer than those of the suite; 0: the same number
    std::string skip{};   ///< why the suite excludes it; recorded as skipped. Empty: it runs
};

/// interleaved: every repetition is a round over all configurations. Each round shuffles the groups of configurations
/// (suite_plan.h) with its own seed and runs those of a group one after the other, so that drift of the machine
/// affects compared configurations equally. batch: all repetitions of a configuration, then the next configuration.
enum class Order { interleaved, batch };
inline constexpr Choices<Order> orders{{"interleaved", Order::interleaved}, {"batch", Order::batch}};

/// What the chart of a suite shows first. Empty: the frame rate against the parameter with the most values.
struct ChartView {
    std::string column;  ///< of summary.csv
    /// A parameter that the suite sets, or `size`, `scene`, `drive`, `seed`; empty: the chart chooses. One of
    /// chartCosts: the report shows this chart first.
    std::string against;
};
/// The costs that charts show the error of pictures against.
inline constexpr std::array<std::string_view, 7> chartCosts{"frame_ms_median",  "method_ms_median", "memory_bytes",
                                                            "gpu_bytes",        "cpu_bytes",        "bits_per_pixel",
                                                            "primitives_median"};

struct Suite {
    std::string id;
    std::string title;
    std::string summary;
    ChartView chart;
    std::vector<PlannedRun> cells;  ///< one repetition each
    int repetitions = 1;
    Order order = Order::interleaved;
    bool baseline = false;        ///< the null method also runs in every world (suite_plan.h)
    double timeoutSeconds = 600;  ///< limit of one run
    ResourceLimits limits;        ///< limits of the process of one run
    double cooldownSeconds = 0;   ///< pause between two runs
    std::vector<PlannedComparison> comparisons;
    std::vector<PlannedFit> fits;
};

/// The suite of a file, and the one with the values of its `[quick]`, if it has that table.
struct SuiteForms {
    Suite full;
    std::optional<Suite> quick;
};

/// Loads a suite by its id or its file. Paths within the file are relative to it. Throws InputError with file, line and
/// what was expected, also for errors in `[quick]`.
[[nodiscard]] SuiteForms loadForms(const std::string& idOrFile);
/// One form of it; `quick` without `[quick]` is the full suite.
[[nodiscard]] Suite loadSuite(const std::string& idOrFile, bool quick);
[[nodiscard]] Suite parseSuite(std::string_view text, const std::string& name, bool quick);

/// One run of a configuration; repetitions count from 1. Only the first has metrics: pictures do not depend on the
/// repetition.
[[nodiscard]] results::RunSpec inRepetition(results::RunSpec cell, int repetition);
/// All runs in order, including those of the null method (suite_plan.h).
[[nodiscard]] std::vector<PlannedRun> planRuns(const Suite& suite);

/// One list of values per parameter, in order.
using ParameterLists = std::vector<std::pair<std::string, std::vector<std::string>>>;
/// Throws InputError for a value that is given twice, also as 100 and 100.0: it would count as two independent runs.
void requireDifferentValues(const MethodInfo& method, const std::string& name, const std::vector<std::string>& values);

/// `base` with every combination of the values set and labelled; the last parameter changes fastest. Throws InputError
/// for more than files::limits::plannedRuns combinations, and for values that are given twice.
[[nodiscard]] std::vector<PlannedRun> expandParameters(const results::RunSpec& base, const MethodInfo& method,
                                                       const ParameterLists& lists);

struct SuiteFile {
    std::string id;
    std::filesystem::path file;
    std::string paper;  ///< empty for suites without a paper
};
/// Every suite in the data folders, sorted by id.
[[nodiscard]] std::vector<SuiteFile> listSuites();

}  // namespace dustbench::suite
