#include "bench/suite/suite_table.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>

#include "bench/results/summary.h"
#include "bench/suite/suite_evaluation.h"
#include "methods/contract/errors.h"

namespace dustbench::suite {
namespace {

using testing::ElementsAre;
using Row = std::vector<std::string>;

PlannedRun cellOf(const std::string& method, const std::string& particles, const results::ParameterTexts& own) {
    PlannedRun cell;
    cell.spec.method = method;
    cell.spec.parameters = own;
    cell.spec.parameters["particles"] = particles;
    cell.spec.parameters["speed"] = "20";
    return cell;
}

void store(results::StoredRuns& runs, const PlannedRun& cell, int repetition, const std::string& fps) {
    results::RunSpec spec = cell.spec;
    spec.repetition = repetition;
    results::StoredRun run;
    run.cells = {{"fps_avg", fps}, {"frame_ms_median", "5.5"}, {"draw_ms_median", "12.3456"}};
    runs[results::runId(spec)] = run;
}

Row firstCells(const Row& row, std::size_t count) {
    return {row.begin(), row.begin() + static_cast<std::ptrdiff_t>(count)};
}

std::string cellAt(const TextRows& table, std::size_t row, const std::string& column) {
    const auto at = std::ranges::find(table.header, column);
    return at == table.header.end() ? "no such column"
                                    : table.rows[row][static_cast<std::size_t>(at - table.header.begin())];
}

TEST(SuiteTable, OneMethodHasAColumnForWhatVaries) {
    Suite suite;
    suite.repetitions = 3;
    for (const char* count : {"100", "200"}) suite.cells.push_back(cellOf("haze", count, {}));
    results::StoredRuns runs;
    for (const int repetition : {1, 2, 3})
        store(runs, suite.cells[0], repetition, std::to_string(10 * repetition * repetition));
    const TextRows table = tabulate(suite, runs);
    EXPECT_THAT(table.header, ElementsAre("method", "particles", "fps", "min", "max", "frame", "input", "simulate",
                                          "build", "sort", "upload", "scene", "draw", "wait"));
    ASSERT_EQ(table.rows.size(), 2u);
    EXPECT_THAT(firstCells(table.rows[0], 6), ElementsAre("haze", "100", "40.0", "10.0", "90.0", "5.500"));
    EXPECT_EQ(cellAt(table, 0, "draw"), "12.35");
    EXPECT_EQ(cellAt(table, 0, "input"), "");
    EXPECT_THAT(firstCells(table.rows[1], 3), ElementsAre("haze (0 of 3 runs)", "200", ""));
}

TEST(SuiteTable, MethodsStandTogetherBelowTheWorldTheyAreShown) {
    Suite suite;
    suite.repetitions = 2;
    for (const char* count : {"100", "200"}) suite.cells.push_back(cellOf("haze", count, {{"sort", "radix"}}));
    for (const char* count : {"100", "200"})
        for (const char* layout : {"plain", "packed"})
            suite.cells.push_back(cellOf("mist", count, {{"sort", "quicksort"}, {"layout", layout}}));
    results::StoredRuns runs;
    for (const PlannedRun& cell : suite.cells) store(runs, cell, 1, "10");
    store(runs, suite.cells[0], 2, "10");
    const TextRows table = tabulate(suite, runs);

    // A setting that differs between methods but not within one is not shown.
    Row names;
    for (const Row& row : table.rows) {
        EXPECT_EQ(row.size(), table.header.size());
        names.push_back(row[0]);
    }
    EXPECT_THAT(names, ElementsAre("particles=100", "  haze", "  mist layout=plain (1 of 2 runs)",
                                   "  mist layout=packed (1 of 2 runs)", "particles=200", "  haze (1 of 2 runs)",
                                   "  mist layout=plain (1 of 2 runs)", "  mist layout=packed (1 of 2 runs)"));
    EXPECT_EQ(cellAt(table, 0, "fps"), "");
    EXPECT_EQ(cellAt(table, 1, "fps"), "10.0");
}

TEST(SuiteTable, ARunThatFailedIsNotCounted) {
    Suite suite;
    suite.cells.push_back(cellOf("haze", "100", {}));
    results::StoredRuns runs;
    store(runs, suite.cells[0], 1, "10");
    runs.begin()->second.status = results::RunStatus::failed;
    EXPECT_EQ(tabulate(suite, runs).rows.at(0).at(0), "haze (0 of 1 runs)");
}

TEST(SuiteTable, InvalidRunsAreMarkedWhereTheirNumbersStand) {
    Suite suite;
    suite.repetitions = 2;
    suite.cells.push_back(cellOf("haze", "100", {}));
    results::StoredRuns runs;
    for (const int repetition : {1, 2}) store(runs, suite.cells[0], repetition, "10");
    runs.begin()->second.cells["invalid"] = "particles_median is 68, requested: 100";
    EXPECT_EQ(tabulate(suite, runs).rows.at(0).at(0), "haze (1 of 2 invalid)");
    const std::vector<const results::StoredRun*> done = doneRuns(suite.cells[0], 2, runs);
    EXPECT_EQ(tabulate({MeasuredCell{"haze", done}}).rows.at(0).at(0), "haze (1 of 2 invalid)");
    EXPECT_EQ(
        results::saysInvalid(done),
        "1 of 2 runs is invalid and left out of claims, fits and verdicts: particles_median is 68, requested: 100");
    EXPECT_EQ(results::saysInvalid({done.back()}), "");
}

TEST(SuiteFit, InvalidRunsAreNoPointsAndAreCounted) {
    Suite suite;
    suite.repetitions = 2;
    suite.fits = {{{"frame_ms_median"}, "particles", ""}};
    results::StoredRuns runs;
    for (const int particles : {100, 200, 400, 800}) {
        suite.cells.push_back(cellOf("haze", std::to_string(particles), {}));
        for (const int repetition : {1, 2}) {
            store(runs, suite.cells.back(), repetition, "10");
            results::StoredRun& run = runs[results::runId(inRepetition(suite.cells.back().spec, repetition))];
            run.cells["frame_ms_median"] = std::to_string(5 + 0.01 * particles);
            if (repetition == 2) run.cells["frame_ms_median"] = "500";  // with another load than requested
            if (repetition == 2) run.cells["invalid"] = "particles_median is 483, requested: 100";
        }
    }
    const FitResult result = fitSuite(suite, runs).at(0);
    EXPECT_EQ(result.curves.at(0).fit.runs, 4u);
    EXPECT_EQ(result.curves.at(0).invalid, 4u);
    EXPECT_NEAR(result.curves.at(0).fit.exponent.value, 1, 0.01);
    EXPECT_EQ(cellAt(tabulate(result), 0, "note"), "4 invalid runs left out");
}

TEST(SuiteTable, RunsThatAreNotTimedHaveTheirCounts) {
    Suite suite;
    suite.cells.push_back(cellOf("haze", "100", {}));
    suite.cells.push_back(cellOf("haze", "200", {}));
    suite.chart.column = "mass_kept";
    results::StoredRuns runs;
    EXPECT_TRUE(isTimed(suite, runs)) << "nothing is known of them yet";
    results::StoredRun run;
    run.cells = {{"fps_avg", ""}, {"mass_kept", "0.01234"}, {"particles_median", "98.5"}, {"cpu_bytes", "123456789"}};
    runs[results::runId(suite.cells[0].spec)] = run;
    EXPECT_FALSE(isTimed(suite, runs));
    const TextRows table = tabulateCounts(suite, runs);
    EXPECT_THAT(table.header, ElementsAre("method", "particles", "mass_kept", "particles_median", "primitives_median",
                                          "cpu_bytes", "gpu_bytes"));
    ASSERT_EQ(table.rows.size(), 2u);
    EXPECT_THAT(table.rows[0], ElementsAre("haze", "100", "0.0123", "98.50", "", "123456789", ""));
    suite.chart.column = "cpu_bytes";
    EXPECT_THAT(tabulateCounts(suite, runs).header,
                ElementsAre("method", "particles", "particles_median", "primitives_median", "cpu_bytes", "gpu_bytes"));
    store(runs, suite.cells[1], 1, "10");
    EXPECT_TRUE(isTimed(suite, runs));
}

TEST(SuiteTable, NumbersKeepFourDigits) {
    EXPECT_EQ(fourDigits(0.04712), "0.047");
    EXPECT_EQ(fourDigits(9.9996), "10.00");
    EXPECT_EQ(fourDigits(99.996), "100.0");
    EXPECT_EQ(fourDigits(1234.5), "1234");
    EXPECT_EQ(fourDigits(std::numeric_limits<double>::quiet_NaN()), "");
}

TEST(SuiteFit, MakesOneCurveOfAllRunsThatAreEqualButForTheLoad) {
    Suite suite;
    suite.repetitions = 2;
    suite.fits = {{{"frame_ms_median", "fps_avg"}, "particles", ""}};
    results::StoredRuns runs;
    for (const char* method : {"haze", "mist"})
        for (const int particles : {100, 200, 400, 800})
            for (const int repetition : {1, 2}) {
                PlannedRun cell = cellOf(method, std::to_string(particles), {});
                cell.spec.repetition = repetition;
                const double ms = method == std::string("haze") ? 5 + 0.01 * particles : 3;
                results::StoredRun& run = runs[results::runId(cell.spec)];
                run.cells = {{"frame_ms_median", std::to_string(ms)}, {"fps_avg", std::to_string(1000 / ms)}};
                if (repetition == 1) suite.cells.push_back(cell);
            }
    const auto results = fitSuite(suite, runs);
    ASSERT_EQ(results.size(), 1u);
    ASSERT_EQ(results[0].curves.size(), 4u);
    const TextRows table = tabulate(results[0]);
    for (const std::size_t row : {0u, 2u}) {
        EXPECT_EQ(cellAt(table, row, "method"), "haze");
        EXPECT_EQ(cellAt(table, row, "loads"), "4");
        EXPECT_EQ(cellAt(table, row, "runs"), "8");
        EXPECT_EQ(cellAt(table, row, "note"), "");
        const measure::CostFit& fit = results[0].curves[row].fit;
        EXPECT_NEAR(fit.fixedMs.value, 5, 1e-3);
        EXPECT_NEAR(fit.exponent.value, 1, 1e-4);
    }
    EXPECT_EQ(cellAt(table, 1, "method"), "mist");
    EXPECT_NE(cellAt(table, 1, "note"), "");
    suite.fits[0].against = "sort";
    EXPECT_THROW((void)cellsByLoad(suite, suite.fits[0]), InputError);
}

}  // namespace
}  // namespace dustbench::suite
