#include "bench/suite/suite_evaluation.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "methods/contract/errors.h"

namespace dustbench::suite {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

constexpr const char* twoSorts = R"(
methods = ["billboard"]
repetitions = 6
[parameters]
particles = [100, 200]
[method.billboard]
sort = ["quicksort", "radix"]
puff = ["gaussian", "texture"]
[[compare]]
of = "billboard sort=quicksort"
with = "billboard sort=radix"
columns = ["sort_ms_median", "fps_avg"]
)";

/// Runs of every configuration: `timeOf` gives the sort time in ms by configuration and repetition, empty for a missing
/// run.
template <typename TimeOf>
results::StoredRuns runsOf(const Suite& suite, const TimeOf& timeOf) {
    results::StoredRuns runs;
    for (const PlannedRun& cell : suite.cells)
        for (int repetition = 1; repetition <= suite.repetitions; ++repetition) {
            const double ms = timeOf(cell.spec.parameters, repetition);
            if (std::isnan(ms)) continue;
            results::RunSpec spec = cell.spec;
            spec.repetition = repetition;
            results::StoredRun run;
            run.cells = {{"sort_ms_median", fmt::format("{}", ms)}, {"fps_avg", fmt::format("{}", 1000 / ms)}};
            runs[results::runId(spec)] = run;
        }
    return runs;
}

/// Quicksort takes `ratio` times as long as radix, alternating ±1 %, on a machine that gets slower.
auto ratioIs(double ratio) {
    return [ratio](const results::ParameterTexts& parameters, int repetition) {
        const double scatter = repetition % 2 ? 1.01 : 0.99;
        return std::stod(parameters.at("particles")) * repetition *
               (parameters.at("sort") == "quicksort" ? ratio * scatter : 1);
    };
}

std::string refusalOf(const std::string& compare, const std::string& more = "") {
    try {
        (void)parseSuite("methods = [\"billboard\"]\n" + more + "[[compare]]\n" + compare, "s.toml", false);
    } catch (const InputError& error) {
        return error.what();
    }
    return "nothing thrown";
}

TEST(SuiteComparison, PairsTheCellsThatShowTheSameWorldInTheSameSetting) {
    const Suite suite = parseSuite(twoSorts, "s", false);
    const MatchedCells matched = matchCells(suite, suite.comparisons.at(0));
    EXPECT_THAT(matched.axes, ElementsAre("particles", "puff"));
    std::set<std::vector<std::string>> at;
    for (const CellPair& pair : matched.pairs) {
        at.insert(pair.at);
        results::ParameterTexts of = pair.of->spec.parameters, with = pair.with->spec.parameters;
        EXPECT_EQ(of.at("sort"), "quicksort");
        EXPECT_EQ(with.at("sort"), "radix");
        of.erase("sort");
        with.erase("sort");
        EXPECT_EQ(of, with);
    }
    EXPECT_EQ(matched.pairs.size(), 4u);
    EXPECT_EQ(at.size(), 4u);
}

TEST(SuiteComparison, RunsOfDifferentMachinesAreNoPair) {
    const Suite suite = parseSuite(twoSorts, "s", false);
    results::StoredRuns runs = runsOf(suite, ratioIs(0.5));
    const PlannedRun* moved = nullptr;
    for (const PlannedRun& cell : suite.cells)
        if (!moved && cell.spec.parameters.at("sort") == "radix") moved = &cell;
    runs.at(results::runId(inRepetition(moved->spec, 2))).provenance["cpu"] = "another";
    const ColumnVerdict column = suiteVerdicts(suite, runs).at(0).columns.at(0);
    int touched = 0;
    for (const CellVerdict& cell : column.cells) {
        if (cell.result.pairs == 6) continue;
        ++touched;
        EXPECT_EQ(cell.result.pairs, 5u);
        EXPECT_EQ(cell.result.verdict, measure::Verdict::unresolved);
        EXPECT_THAT(cell.reason, HasSubstr("5 paired runs, 6 are needed; pairs from different machines were left out"));
    }
    EXPECT_EQ(touched, 1);
    EXPECT_EQ(column.overall.result.pairs, 5u);
    EXPECT_THAT(column.overall.reason, HasSubstr("'another'"));
}

TEST(SuiteComparison, AnInvalidRunIsNoPairAndIsCounted) {
    const Suite suite = parseSuite(twoSorts, "s", false);
    results::StoredRuns runs = runsOf(suite, ratioIs(0.5));
    for (const int repetition : {2, 5})
        runs.at(results::runId(inRepetition(suite.cells.front().spec, repetition))).cells["invalid"] =
            "particles_median is 9";
    const ColumnVerdict column = suiteVerdicts(suite, runs).at(0).columns.at(0);
    int touched = 0;
    for (const CellVerdict& cell : column.cells) {
        if (cell.result.pairs == 6) continue;
        ++touched;
        EXPECT_EQ(cell.result.pairs, 4u);
        EXPECT_EQ(cell.result.verdict, measure::Verdict::unresolved);
        EXPECT_EQ(cell.reason,
                  "4 paired runs, 6 are needed; 2 pairs with an invalid run were left out (particles_median is 9)");
    }
    EXPECT_EQ(touched, 1);
    EXPECT_EQ(column.overall.result.pairs, 4u);
    EXPECT_THAT(conclusions(suiteVerdicts(suite, runs).at(0)).front(), HasSubstr("2 pairs with an invalid run"));
}

TEST(SuiteComparison, ASettingThatOneSideAloneVariesIsComparedForEachOfItsValues) {
    // Like methods that lack each other's parameters: one side always has `texture`.
    Suite suite = parseSuite(twoSorts, "s", false);
    std::erase_if(suite.cells, [](const PlannedRun& cell) {
        return cell.spec.parameters.at("sort") == "radix" && cell.spec.parameters.at("puff") == "gaussian";
    });
    const MatchedCells matched = matchCells(suite, suite.comparisons.at(0));
    EXPECT_THAT(matched.axes, ElementsAre("particles", "puff"));
    EXPECT_EQ(matched.pairs.size(), 4u);
    for (const CellPair& pair : matched.pairs) EXPECT_EQ(pair.with->spec.parameters.at("puff"), "texture");
}

TEST(SuiteComparison, FindsTheRatioWithWhichTheTimesWereMade) {
    const Suite suite = parseSuite(twoSorts, "s", false);
    const auto results = suiteVerdicts(suite, runsOf(suite, ratioIs(0.8)));
    ASSERT_EQ(results.size(), 1u);
    EXPECT_EQ(results[0].of, "billboard sort=quicksort");
    ASSERT_EQ(results[0].columns.size(), 2u);
    for (const ColumnVerdict& column : results[0].columns) {
        // FPS as well: fewer ms are more frames, and FASTER.
        EXPECT_EQ(column.cells.size(), 4u);
        for (const CellVerdict& cell : column.cells) {
            EXPECT_NEAR(cell.result.ratio, 0.8, 1e-4) << column.column;
            EXPECT_EQ(cell.result.pairs, 6u);
            EXPECT_EQ(cell.result.verdict, measure::Verdict::faster);
            EXPECT_LT(cell.result.low, 0.8);
            EXPECT_GT(cell.result.high, 0.8);
        }
        EXPECT_NEAR(column.overall.result.ratio, 0.8, 1e-4);
        EXPECT_EQ(column.overall.result.pairs, 6u);
        EXPECT_EQ(column.overall.result.verdict, measure::Verdict::faster);
    }
    const auto slower = suiteVerdicts(suite, runsOf(suite, ratioIs(1.25)));
    EXPECT_EQ(slower[0].columns[0].overall.result.verdict, measure::Verdict::slower);
    const auto same = suiteVerdicts(suite, runsOf(suite, ratioIs(1)));
    EXPECT_EQ(same[0].columns[0].overall.result.verdict, measure::Verdict::same);
    EXPECT_THAT(conclusions(same[0])[0], HasSubstr("SAME within 2 %"));
}

TEST(SuiteComparison, AllTogetherIsTheGeometricMeanOverCellsAndItsScatterThatOfRounds) {
    // Ratios 0.5 and 2 in every round: clear and opposite per configuration, no scatter for both together.
    const Suite suite = parseSuite(twoSorts, "s", false);
    const auto results =
        suiteVerdicts(suite, runsOf(suite, [](const results::ParameterTexts& parameters, int repetition) {
                          const double ratio = parameters.at("particles") == "100" ? 0.5 : 2;
                          return repetition * (parameters.at("sort") == "quicksort" ? ratio : 1);
                      }));
    const measure::PairedRatio& overall = results[0].columns[0].overall.result;
    EXPECT_NEAR(overall.ratio, 1, 1e-12);
    EXPECT_NEAR(overall.high - overall.low, 0, 1e-12);
    EXPECT_EQ(overall.verdict, measure::Verdict::same);
}

TEST(SuiteComparison, ARunThatIsMissingCostsItsPairAndItsRound) {
    const Suite suite = parseSuite(twoSorts, "s", false);
    const auto times = ratioIs(0.8);
    const auto results = suiteVerdicts(
        suite, runsOf(suite, [&](const results::ParameterTexts& parameters, int repetition) {
            const bool missing = repetition == 3 && parameters.at("sort") == "radix" &&
                                 parameters.at("particles") == "200" && parameters.at("puff") == "texture";
            return missing ? std::nan("") : times(parameters, repetition);
        }));
    const ColumnVerdict& column = results[0].columns[0];
    EXPECT_EQ(column.overall.result.pairs, 5u);
    EXPECT_EQ(column.overall.result.verdict, measure::Verdict::unresolved);
    int incomplete = 0;
    for (const CellVerdict& cell : column.cells) {
        if (cell.result.pairs == 6) continue;
        ++incomplete;
        EXPECT_THAT(cell.at, ElementsAre("200", "texture"));
        EXPECT_EQ(cell.result.verdict, measure::Verdict::unresolved);
        EXPECT_EQ(cell.reason, "5 paired runs, 6 are needed");
    }
    EXPECT_EQ(incomplete, 1);
}

TEST(SuiteComparison, CellsThatWereNeverMeasuredDoNotHideTheOthers) {
    const Suite suite = parseSuite(twoSorts, "s", false);
    const auto times = ratioIs(0.8);
    const auto results =
        suiteVerdicts(suite, runsOf(suite, [&](const results::ParameterTexts& parameters, int repetition) {
                          return parameters.at("particles") == "200" ? std::nan("") : times(parameters, repetition);
                      }));
    EXPECT_EQ(results[0].columns[0].overall.result.verdict, measure::Verdict::faster);

    const auto none = suiteVerdicts(suite, {});
    EXPECT_EQ(
        conclusions(none[0])[0],
        "sort_ms_median: billboard sort=quicksort against billboard sort=radix: UNRESOLVED: no paired runs with a "
        "time above 0");
}

TEST(SuiteComparison, TimesOfZeroAreNotCompared) {
    const Suite suite = parseSuite(twoSorts, "s", false);
    const auto results =
        suiteVerdicts(suite, runsOf(suite, [](const results::ParameterTexts& parameters, int) {
                          return parameters.at("sort") == "quicksort" && parameters.at("particles") == "100" ? 0. : 1.;
                      }));
    for (const CellVerdict& cell : results[0].columns[0].cells)
        EXPECT_EQ(cell.result.pairs, cell.at[0] == "100" ? 0u : 6u);
}

TEST(SuiteComparison, RunsInBatchesResolveNothing) {
    Suite suite = parseSuite(twoSorts, "s", false);
    suite.order = Order::batch;
    const auto results = suiteVerdicts(suite, runsOf(suite, ratioIs(0.5)));
    EXPECT_EQ(results[0].columns[0].overall.result.verdict, measure::Verdict::unresolved);
    EXPECT_THAT(conclusions(results[0])[0], HasSubstr("not interleaved"));
}

TEST(SuiteComparison, TheTableHasARowForEachColumnAndCell) {
    const Suite suite = parseSuite(twoSorts, "s", false);
    const auto results = suiteVerdicts(suite, runsOf(suite, ratioIs(0.8)));
    const TextRows table = tabulate(results[0]);
    EXPECT_THAT(table.header, ElementsAre("column", "particles", "puff", "ratio", "low", "high", "pairs", "verdict"));
    ASSERT_EQ(table.rows.size(), 2u * 5u);
    for (const auto& row : table.rows) EXPECT_EQ(row.size(), table.header.size());
    EXPECT_THAT(table.rows[0],
                ElementsAre("sort_ms_median", "100", "gaussian", "0.800", "0.791", "0.809", "6", "FASTER"));
    EXPECT_THAT(table.rows[4], ElementsAre("sort_ms_median, all", "", "", "0.800", "0.791", "0.809", "6", "FASTER"));
    EXPECT_EQ(
        conclusions(results[0])[0],
        "sort_ms_median: billboard sort=quicksort takes 0.800 [0.791, 0.809] of the time of billboard sort=radix: "
        "FASTER");
}

TEST(SuiteComparison, QuickMayReplaceOrDropIt) {
    const std::string file = twoSorts;
    EXPECT_EQ(parseSuite(file + "[quick]\nframes = 5", "s", true).comparisons.size(), 1u);
    EXPECT_TRUE(parseSuite(file + "[quick]\ncompare = []", "s", true).comparisons.empty());
    const Suite replaced = parseSuite(file +
                                          "[[quick.compare]]\nof = \"billboard puff=texture\"\n"
                                          "with = \"billboard puff=gaussian\"\ncolumns = [\"frame_ms_p95\"]",
                                      "s", true);
    ASSERT_EQ(replaced.comparisons.size(), 1u);
    EXPECT_EQ(replaced.comparisons[0].of.label, "billboard puff=texture");
}

TEST(SuiteComparison, MistakesNameFileLineAndWhatIsNear) {
    const std::string of = "of = \"billboard sort=radix\"\n", with = "with = \"billboard sort=none\"\n";
    const std::string columns = "columns = [\"fps_avg\"]\n";
    const std::string sorts = "[parameters]\nsort = [\"radix\", \"none\"]\n";
    EXPECT_EQ(refusalOf(of + with + columns, sorts), "nothing thrown");
    const std::vector<std::pair<std::string, std::string>> mistakes{
        {"of = \"bilboard\"\n" + with + columns, "s.toml:5: key 'compare.of': unknown method of this suite 'bilboard'"},
        {"of = \"\"\n" + with + columns, "s.toml:5: key 'compare.of': got no method"},
        {of + "with = \"billboard srt=none\"\n" + columns, "'sort'"},
        {of + "with = \"billboard sort=nine\"\n" + columns, "s.toml:6"},
        {of + "with = \"billboard sort\"\n" + columns, "expected name=value"},
        {"of = \"billboard sort=radix sort=none\"\n" + with + columns, "'sort' twice"},
        {of + with + "columns = [\"frame_ms_medial\"]\n", "'frame_ms_median'"},
        {of + with + "columns = [\"cpu_bytes\"]\n", "s.toml:7: unknown column to compare 'cpu_bytes'"},
        {of + with + "columns = []\n", "s.toml:7: key 'compare.columns': got an empty array"},
        {of + with + "columns = [\"fps_avg\", \"fps_avg\"]\n", "'fps_avg' twice"},
        {of + columns, "'compare.with' is missing"},
        {of + with + columns + "colums = 3\n", "'columns'"},
        {"of = \"billboard sort=quicksort\"\n" + with + columns, "s.toml:4: compare: got 'billboard sort=quicksort'"},
        {"of = \"billboard\"\nwith = \"billboard\"\n" + columns, "no different runs"},
    };
    for (const auto& [text, expected] : mistakes) EXPECT_THAT(refusalOf(text, sorts), HasSubstr(expected)) << text;
    try {
        (void)parseSuite("compare = 5", "s.toml", false);
        FAIL() << "nothing thrown";
    } catch (const InputError& error) {
        EXPECT_THAT(error.what(), HasSubstr("s.toml:1: key 'compare': got 5, expected tables [[compare]]"));
    }
}

}  // namespace
}  // namespace dustbench::suite
