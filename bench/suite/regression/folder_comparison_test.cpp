#include "bench/suite/regression/folder_comparison.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <functional>
#include <iterator>

#include "bench/suite/regression/regression_table.h"
#include "methods/contract/errors.h"
#include "methods/kit/files/csv.h"
#include "source_folder.h"

namespace dustbench::suite {
namespace {

using testing::AllOf;
using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

results::StoredRun runOf(const std::string& method, int particles, int repetition, double ms) {
    results::StoredRun run;
    run.runId = fmt::format("{}-{}-r{}", method, particles, repetition);
    run.cells = {{"frame_ms_median", fmt::format("{}", ms)},
                 {"fps_avg", fmt::format("{}", 1000 / ms)},
                 {"repetition", fmt::format("{}", repetition)}};
    run.stateHash = fmt::format("state of {}", particles);
    run.inputs = {{"scenes/plain.toml", "01"}};
    run.provenance = {
        {"cpu", "Cpu 1"},
        {"build_type", "Release"},
        {"key", fmt::format("method={}\nscene=plain\ndrive=\np.particles={}\n{}frames=9\nrepetition={}\n{}", method,
                            particles, method == "haze" ? "p.thin=on\n" : "", repetition,
                            repetition == 1 ? "metrics=\nmetric_reference=exact\n" : "")}};
    return run;
}

/// Two methods with two numbers of particles; times are `factor` times the normal ones, ±1 %.
results::StoredRuns session(double factor, int repetitions = 6) {
    results::StoredRuns runs;
    for (const char* method : {"haze", "fog"})
        for (const int particles : {1000, 200})
            for (int k = 1; k <= repetitions; ++k) {
                const results::StoredRun run = runOf(method, particles, k, particles * factor * (k % 2 ? 1.01 : 0.99));
                runs[run.runId] = run;
            }
    return runs;
}

FolderComparison compare(results::StoredRuns a, results::StoredRuns b, bool acrossMachines = false,
                         const std::vector<std::string>& columns = {"frame_ms_median"}) {
    return compareFolders({"a/", std::move(a)}, {"b/", std::move(b)}, columns, acrossMachines);
}

results::StoredRuns with(results::StoredRuns runs, const std::string& id,
                         const std::function<void(results::StoredRun&)>& change) {
    change(runs.at(id));
    return runs;
}

TEST(FolderComparison, FindsTheRatioOfEveryCellAndOfAllTogether) {
    // The sides must outlive the result, which points into them.
    const ResultsSide a{"a/", session(1)}, b{"b/", session(1.1)};
    const FolderComparison result = compareFolders(a, b, {"frame_ms_median", "fps_avg"}, false);
    EXPECT_THAT(result.obstacles, IsEmpty());
    EXPECT_THAT(result.remarks, IsEmpty());
    EXPECT_THAT(result.axes, ElementsAre("p.particles"));
    ASSERT_EQ(result.evaluated.size(), 10u);
    // ±1 % alternating: s² = 6·h²/5 of the logarithms, with h half their distance.
    const double h = std::log(1.01 / 0.99) / 2;
    const double half = measure::studentQuantile(0.975, 10) * std::sqrt(2 * h * h / 5);
    for (const EvaluatedCell& evaluated : result.evaluated) {
        EXPECT_NEAR(evaluated.result.ratio, 1.1, 1e-4) << evaluated.column;
        EXPECT_NEAR(std::log(evaluated.result.high / evaluated.result.low), 2 * half, 1e-4);
        EXPECT_EQ(evaluated.result.verdict, measure::Verdict::slower);
        EXPECT_EQ(evaluated.result.ofCount, 6u);
        EXPECT_TRUE(isSlowerBy(evaluated, 5));
        EXPECT_FALSE(isSlowerBy(evaluated, 10));
    }
    EXPECT_EQ(labelOf(*result.evaluated[0].cell, result.axes), "fog particles=200");
    EXPECT_EQ(labelOf(*result.evaluated[1].cell, result.axes), "fog particles=1000");
    EXPECT_EQ(result.evaluated[4].cell, nullptr);
}

TEST(FolderComparison, AllTogetherCountsWhatARoundHasInCommonOnce) {
    // Each round of A is slower or faster as a whole: four configurations give no more information about it than one.
    results::StoredRuns a = session(1), b = session(1);
    for (results::StoredRuns* runs : {&a, &b})
        for (auto& [id, run] : *runs) {
            const double drift = std::stoi(run.cells.at("repetition")) % 3 == 0 ? 1.3 : 0.9;
            run.cells["frame_ms_median"] = fmt::format("{}", drift * std::stod(run.cells["frame_ms_median"]));
        }
    const FolderComparison result = compare(a, b);
    const auto width = [](const EvaluatedCell& evaluated) {
        return std::log(evaluated.result.high / evaluated.result.low);
    };
    EXPECT_NEAR(width(result.evaluated[4]), width(result.evaluated[0]), 1e-6);
    EXPECT_EQ(result.evaluated[4].result.verdict, measure::Verdict::unresolved);
}

TEST(FolderComparison, TooFewRunsResolveNothingAndAreNoRegression) {
    const FolderComparison result = compare(session(1), session(3, 5));
    for (const EvaluatedCell& evaluated : result.evaluated) {
        EXPECT_EQ(evaluated.result.verdict, measure::Verdict::unresolved);
        EXPECT_FALSE(isSlowerBy(evaluated, 5));
        EXPECT_THAT(evaluated.reason, HasSubstr("6 and 5"));
    }
}

TEST(FolderComparison, OtherMachinesAreAnObstacleUnlessAllowed) {
    results::StoredRuns other = session(1);
    for (auto& [id, run] : other) run.provenance["cpu"] = "Cpu 2";
    EXPECT_THAT(compare(session(1), other).obstacles,
                ElementsAre("cpu: 'Cpu 1' in A and 'Cpu 2' in B (4 configurations)"));
    EXPECT_THAT(compare(session(1), other).evaluated, IsEmpty());
    const FolderComparison allowed = compare(session(1), other, true);
    EXPECT_THAT(allowed.obstacles, IsEmpty());
    EXPECT_THAT(allowed.remarks, Contains(HasSubstr("'Cpu 2' in B")));
    EXPECT_EQ(allowed.evaluated.size(), 5u);
    // One run from another machine in the same folder.
    const auto mixed =
        with(session(1), "haze-200-r4", [](results::StoredRun& run) { run.provenance["build_type"] = "Debug"; });
    EXPECT_THAT(compare(mixed, session(1)).obstacles,
                ElementsAre("build_type: 'Release' in A and 'Debug' in A (1 configuration)"));
}

TEST(FolderComparison, OtherWorkIsAnObstacleAlways) {
    const auto other = with(session(1), "fog-200-r3", [](results::StoredRun& run) { run.stateHash = "another"; });
    EXPECT_THAT(
        compare(session(1), other, true).obstacles,
        ElementsAre(AllOf(HasSubstr("particles=200: the runs did different work"), HasSubstr("'another' in B"))));
    const auto inputs = with(session(1), "fog-200-r3", [](results::StoredRun& run) { run.inputs[0].sha256 = "02"; });
    EXPECT_THAT(compare(inputs, session(1), true).obstacles, ElementsAre(HasSubstr("scenes/plain.toml")));
}

TEST(FolderComparison, SaysWhatTheNearestDiffersInWhereNothingIsInBoth) {
    results::StoredRuns other = session(1);
    for (auto& [id, run] : other) run.provenance["key"] += "volumes=1\n";
    EXPECT_THAT(compare(session(1), other).obstacles,
                ElementsAre(AllOf(HasSubstr("4 configurations of 24 runs in A"), HasSubstr("differ in volumes"))));
    EXPECT_THAT(compare(session(1), {}).obstacles, ElementsAre(HasSubstr("0 configurations of 0 runs in B")));
}

TEST(FolderComparison, NothingIsSilent) {
    results::StoredRuns a = session(1), b = session(1);
    for (int k = 1; k <= 6; ++k) a.erase(fmt::format("fog-200-r{}", k));
    for (int k = 5; k <= 6; ++k) {
        results::StoredRun& run = b.at(fmt::format("haze-200-r{}", k));
        run.status = k == 5 ? results::RunStatus::failed : results::RunStatus::timeout;
        run.reason = "too long";
        run.provenance.erase("cpu");  // a failed run may not have it
    }
    b.at("haze-1000-r1").warnings = {"busy"};
    for (auto& [id, run] : b)
        if (run.status == results::RunStatus::done) run.provenance["compiler"] = "GNU 13";
    const FolderComparison result = compare(a, b);
    EXPECT_THAT(result.obstacles, IsEmpty());
    EXPECT_THAT(result.remarks, Contains("fog particles=200: only in B, 6 runs"));
    EXPECT_THAT(result.remarks, Contains("haze particles=200: 2 of 6 runs failed in B: too long"));
    EXPECT_THAT(result.remarks, Contains("B: 1 of 22 runs carry warnings, the first: busy"));
    EXPECT_THAT(result.remarks, Contains("compiler: '' in A and 'GNU 13' in B (3 configurations)"));
    EXPECT_EQ(result.broken.size(), 1u);
}

TEST(FolderComparison, InvalidRunsAreLeftOutWithTheirCountAndBreakACellThatWasValid) {
    results::StoredRuns a = session(1), b = session(1.001);
    for (int k = 1; k <= 6; ++k) {
        for (results::StoredRuns* runs : {&a, &b})
            runs->at(fmt::format("fog-200-r{}", k)).cells["invalid"] = "clipped is 4";
        b.at(fmt::format("fog-200-r{}", k)).cells["frame_ms_median"] = "9999";
    }
    const FolderComparison both = compare(a, b);
    EXPECT_EQ(both.evaluated.size(), 4u);  // three configurations, and all together
    EXPECT_NEAR(both.evaluated.back().result.ratio, 1.001, 1e-4);
    EXPECT_THAT(both.remarks,
                Contains("B: 6 of 24 runs are invalid and left out of claims, fits and verdicts: clipped is 4"));
    EXPECT_THAT(both.broken, IsEmpty());

    const ResultsSide valid{"a/", session(1)}, invalid{"b/", b};
    const FolderComparison newly = compareFolders(valid, invalid, {"frame_ms_median"}, false);
    ASSERT_EQ(newly.broken.size(), 1u);
    EXPECT_EQ(whyBroken(*newly.broken.front()), "invalid: clipped is 4");
    EXPECT_THAT(comparisonCsv(newly, 5), HasSubstr("not valid in B"));
}

TEST(FolderComparison, ACopiedRunIsNoMeasurementOfItsOwn) {
    const auto started = [](results::StoredRuns runs) {
        for (auto& [id, run] : runs) run.provenance["started_utc"] = "2026-01-02T03:04:05Z";
        return runs;
    };
    const results::StoredRuns a = started(session(1));
    EXPECT_THAT(compare(a, a).obstacles, ElementsAre(HasSubstr("24 runs of B are copied from A")));
    // Measured in the same second, with different numbers.
    EXPECT_THAT(compare(a, started(session(1.001))).obstacles, IsEmpty());
    results::StoredRuns b = started(session(1.1));
    for (int k = 1; k <= 6; ++k) b[fmt::format("fog-200-r{}", k)] = a.at(fmt::format("fog-200-r{}", k));
    const FolderComparison some = compare(a, b);
    EXPECT_THAT(some.obstacles, IsEmpty());
    EXPECT_THAT(some.remarks, Contains(HasSubstr("6 runs of B are copied from A")));
    EXPECT_EQ(some.evaluated.size(), 4u);
    EXPECT_NEAR(some.evaluated.back().result.ratio, 1.1, 1e-4);
}

TEST(FolderComparison, AnotherQuotaOrEnvironmentIsSaid) {
    results::StoredRuns b = session(1.001);
    for (auto& [id, run] : b) {
        run.provenance["quota_cores"] = "0.5";
        run.provenance["environment"] = "LP_NUM_THREADS=2";
    }
    const FolderComparison result = compare(session(1), b);
    EXPECT_THAT(result.remarks, Contains("quota_cores: '' in A and '0.5' in B (4 configurations)"));
    EXPECT_THAT(result.remarks, Contains("environment: '' in A and 'LP_NUM_THREADS=2' in B (4 configurations)"));
}

TEST(FolderComparison, TheCsvHasARowForEveryCellWhateverBecameOfIt) {
    const ResultsSide a{"a/", session(1)};
    ResultsSide b{"b/", session(1.2)};
    for (int k = 1; k <= 6; ++k) b.runs.erase(fmt::format("haze-200-r{}", k));
    const FolderComparison result = compareFolders(a, b, {"frame_ms_median"}, false);
    const auto table = files::CsvTable::parseText(comparisonCsv(result, 5), "comparison.csv");
    ASSERT_EQ(table.rows(), 5u);
    EXPECT_EQ(table.cell(0, "method"), "fog");
    EXPECT_EQ(table.number(0, "p.particles"), 200);
    EXPECT_NEAR(table.number(0, "ratio"), 1.2, 1e-4);
    EXPECT_EQ(table.cell(0, "regression"), "1");
    EXPECT_EQ(table.cell(3, "all_cells"), "1");
    EXPECT_EQ(table.cell(4, "reason"), "not done in B");
    EXPECT_EQ(table.number(4, "runs_a"), 6);
    EXPECT_EQ(table.cell(4, "ratio"), "");
}

TEST(FolderComparison, EveryColumnOfTheCsvIsDescribed) {
    std::ifstream file(std::string(DUSTBENCH_SOURCE_DIR) + "/reports/SCHEMA.md");
    std::string page{std::istreambuf_iterator<char>(file), {}};
    page = page.substr(page.find("## Two folders"));
    std::vector<std::string> names = comparisonColumnsBefore();
    for (std::string& name : comparisonColumnsAfter()) names.push_back(std::move(name));
    for (const auto& [name, value] : identityOf(runOf("haze", 1, 1, 1))) names.push_back(name);
    for (const std::string& name : names)
        EXPECT_THAT(page, HasSubstr("`" + (name.starts_with("p.") ? "p.<name>" : name) + "`"));
}

TEST(FolderComparison, RefusesARunThatDoesNotSayWhatItWas) {
    const auto broken = with(session(1), "fog-200-r3", [](results::StoredRun& run) { run.provenance.erase("key"); });
    EXPECT_THROW((void)compare(broken, session(1)), InputError);
}

}  // namespace
}  // namespace dustbench::suite
