// Each kind of rule, evaluated on results with a known answer. Over 400 lines: all kinds share the same results.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <tuple>
#include <vector>

#include "bench/claims/claim_ledger.h"
#include "methods/kit/maths/philox.h"

namespace dustbench::claims {
namespace {

constexpr int rulesRepetitions = 6;

/// ms of a method in a world: `value(method, particles, repetition)`; empty for a failed run.
using ValueOf = std::function<double(const std::string&, int, int)>;

/// Two methods, three loads, six repetitions; `haze` has a parameter of its own.
files::CsvTable table(const ValueOf& value) {
    std::string text =
        "run_id,status,method,scene,repetition,p.particles,p.sort,frame_ms_median,draw_ms_median,popping\n";
    int id = 0;
    for (const char* method : {"haze", "mist"})
        for (const int particles : {100, 200, 400, 800})
            for (int repetition = 1; repetition <= rulesRepetitions; ++repetition) {
                const double ms = value(method, particles, repetition);
                text +=
                    fmt::format("run{},{},{},plain,{},{},{},{},{},{}\n", id++, std::isfinite(ms) ? "done" : "failed",
                                method, repetition, particles, method[0] == 'h' ? "radix" : "", ms, 0.8 * ms,
                                repetition == 1 ? fmt::format("{}", ms) : "");
            }
    return files::CsvTable::parseText(text, "summary.csv");
}

/// Deterministic scatter of about one per cent.
double scatter(int particles, int repetition, std::uint32_t stream) {
    const auto words = maths::randomWords(
        9, stream, static_cast<std::uint64_t>(particles) * 100 + static_cast<std::uint64_t>(repetition));
    return 1 + 0.01 * static_cast<double>(maths::unitFloat(words[0]) + maths::unitFloat(words[1]) - 1);
}

Claim ruledClaim(const std::string& rule) {
    return parseClaims("[[claim]]\nid = \"X\"\ntext = \"t\"\nsuite = \"s\"\nreason = \"r\"\n" + rule, "claims.toml")
        .at(0);
}

ClaimResult evaluated(const std::string& rule, const ValueOf& value) {
    const files::CsvTable rows = table(value);
    return evaluateRule(ruledClaim(rule).rule, ResultRows(rows, nullptr));
}

/// Haze takes `ratio` times as long as mist in every world.
ValueOf ratioOf(double ratio) {
    return [ratio](const std::string& method, int particles, int repetition) {
        const bool haze = method == "haze";
        return (haze ? ratio : 1) * (5 + 0.01 * particles) * scatter(particles, repetition, haze ? 1 : 2);
    };
}

const std::string faster =
    "quantity = \"ratio\"\ncolumn = \"frame_ms_median\"\nof = \"haze\"\nwith = \"mist\"\nmax = 1\n";

TEST(ClaimRules, PairRunsWhoseDustIsOnTheSameSide) {
    std::string text = "run_id,status,method,scene,repetition,frame_ms_median,dust_on\n";
    int id = 0;
    for (const char* place : {"cpu", "gpu"})
        for (const char* method : {"haze", "mist"})
            for (int repetition = 1; repetition <= rulesRepetitions; ++repetition) {
                const double ms = (place[0] == 'g' ? 100 : 1) * (method[0] == 'h' ? 0.9 : 1);
                text += fmt::format("run{},done,{},plain,{},{},{}\n", id++, method, repetition, ms, place);
            }
    const files::CsvTable rows = files::CsvTable::parseText(text, "summary.csv");
    const ClaimResult result = evaluateRule(ruledClaim(faster).rule, ResultRows(rows, nullptr));
    EXPECT_EQ(result.cells.size(), 2u);
    EXPECT_NEAR(result.low, 0.9, 1e-9);
    EXPECT_NEAR(result.high, 0.9, 1e-9);
}

TEST(ClaimRules, ARatioTurnsRoundWithTheTimes) {
    const ClaimResult holds = evaluated(faster, ratioOf(0.9));
    EXPECT_EQ(holds.verdict, ClaimVerdict::confirmed);
    EXPECT_NEAR(holds.measured, 0.9, 0.01);
    EXPECT_LT(holds.low, holds.measured);
    EXPECT_GT(holds.high, holds.measured);
    EXPECT_EQ(holds.runs.size(), 48u);
    // The same table with the method names swapped.
    const ValueOf value = ratioOf(0.9);
    const ClaimResult reversed = evaluated(faster, [&](const std::string& method, int particles, int repetition) {
        return value(method == "haze" ? "mist" : "haze", particles, repetition);
    });
    EXPECT_EQ(reversed.verdict, ClaimVerdict::refuted);
    EXPECT_EQ(evaluated(faster, ratioOf(1)).verdict, ClaimVerdict::unresolved);
}

TEST(ClaimRules, ARatioPairsTheSameWorldAndRepetitionAlone) {
    // Rounds drift by a factor of three; only pairs within a round reveal the small difference.
    const auto drifting = [](const std::string& method, int particles, int repetition) {
        return (method == "haze" ? 0.97 : 1) * particles * (1 + repetition % 3);
    };
    const ClaimResult result = evaluated(faster, drifting);
    EXPECT_EQ(result.verdict, ClaimVerdict::confirmed);
    EXPECT_NEAR(result.low, 0.97, 1e-9);
    EXPECT_NEAR(result.high, 0.97, 1e-9);
}

/// Times minus a baseline, of either sign: one for each repetition, the same in every world.
ValueOf differences(const std::vector<double>& mist, double ratio) {
    return [=](const std::string& method, int, int repetition) {
        return (method == "haze" ? ratio : 1) * mist[static_cast<std::size_t>(repetition - 1)];
    };
}

TEST(ClaimRules, ARatioOfTimesNearZeroIsThatOfTheMeans) {
    const std::string twice =
        "quantity = \"ratio\"\ncolumn = \"frame_ms_median\"\nof = \"haze\"\nwith = \"mist\"\nmin = 2\n";
    const std::vector<double> clear{-0.1, 1.9, 1.2, 1.5, 0.9, 1.6}, lost{-0.9, 1.1, 0.2, 0.5, -0.1, -0.6};
    const ClaimResult holds = evaluated(twice, differences(clear, 3));
    EXPECT_EQ(holds.verdict, ClaimVerdict::confirmed);
    for (const ClaimCell& cell : holds.cells) {
        EXPECT_EQ(cell.turns, 6u) << "no repetition is left out";
        EXPECT_NEAR(cell.measured, 3, 1e-9);
    }
    EXPECT_EQ(evaluated(twice, differences(clear, 1)).verdict, ClaimVerdict::refuted);
    const ClaimResult open = evaluated(twice, differences(lost, 3));
    EXPECT_EQ(open.verdict, ClaimVerdict::unresolved);
}

TEST(ClaimRules, AFindingThatWasNotMeasuredTestsNothingAndItsNoteSaysWhy) {
    Rule rule;
    rule.quantity = Quantity::finding;
    rule.experiment = "ageing";
    rule.column = "crossover";
    rule.minimum = 0;
    StoredFinding finding;
    finding.experiment = rule.experiment;
    finding.quantity = rule.column;
    finding.value = finding.low = finding.high = std::nan("");
    finding.note = "skipped: too many tests";
    const ClaimResult skipped = evaluateFinding(rule, {finding});
    EXPECT_EQ(skipped.verdict, ClaimVerdict::notTested);
    EXPECT_EQ(skipped.note, finding.note);
    finding.value = finding.low = finding.high = 1;
    finding.note = "one of two cells skipped";
    const ClaimResult partly = evaluateFinding(rule, {finding});
    EXPECT_EQ(partly.verdict, ClaimVerdict::confirmed);
    EXPECT_EQ(partly.note, finding.note);
}

TEST(ClaimRules, FewerRepetitionsThanSixResolveNothing) {
    const ClaimResult result = evaluated(faster, [](const std::string& method, int particles, int repetition) {
        return repetition == 2 ? std::nan("") : (method == "haze" ? 0.5 : 1) * particles;
    });
    EXPECT_EQ(result.verdict, ClaimVerdict::unresolved);
    EXPECT_EQ(result.note, "5 repetitions, 6 are needed");
}

TEST(ClaimRules, AShareIsOfTheSumOfItsParts) {
    const auto rule = [](double minimum) {
        return fmt::format(
            "quantity = \"share\"\ncolumn = \"frame_ms_median\"\nparts = [\"draw_ms_median\"]\nof = \"mist\"\nmin = "
            "{}\n",
            minimum);
    };
    EXPECT_EQ(evaluated(rule(0.5), ratioOf(1)).verdict, ClaimVerdict::confirmed);
    EXPECT_EQ(evaluated(rule(0.9), ratioOf(1)).verdict, ClaimVerdict::refuted);
    EXPECT_NEAR(evaluated(rule(0.9), ratioOf(1)).measured, 0.8, 1e-9);
}

TEST(ClaimRules, AGrowthIsFromTheMinimumLoadToTheMaximum) {
    const std::string rule =
        "quantity = \"growth\"\ncolumn = \"frame_ms_median\"\nagainst = \"p.particles\"\nof = \"mist\"\nmin = ";
    const ClaimResult result = evaluated(rule + "2\n", ratioOf(1));
    EXPECT_NEAR(result.measured, 13.0 / 6, 0.05);
    EXPECT_EQ(result.verdict, ClaimVerdict::confirmed);
    EXPECT_EQ(evaluated(rule + "3\n", ratioOf(1)).verdict, ClaimVerdict::refuted);
}

TEST(ClaimRules, AColumnMayBeTakenPerUnitOfAnother) {
    const std::string rule =
        "quantity = \"growth\"\ncolumn = \"frame_ms_median\"\nper = \"p.particles\"\nagainst = \"p.particles\"\n"
        "of = \"mist\"\nmax = 1.1\n";
    const auto power = [](double k) {
        return [k](const std::string&, int particles, int repetition) {
            return std::pow(particles, k) * scatter(particles, repetition, 5);
        };
    };
    EXPECT_EQ(evaluated(rule, power(1)).verdict, ClaimVerdict::confirmed);
    EXPECT_NEAR(evaluated(rule, power(1)).measured, 1, 0.02);
    EXPECT_EQ(evaluated(rule, power(2)).verdict, ClaimVerdict::refuted);
}

TEST(ClaimRules, AnExponentIsThatOfTheFittedCurve) {
    const std::string rule =
        "quantity = \"exponent\"\ncolumn = \"frame_ms_median\"\nagainst = \"p.particles\"\nof = \"mist\"\n";
    const auto power = [](double k) {
        return [k](const std::string&, int particles, int repetition) {
            return (1 + 0.01 * std::pow(particles, k)) * (1 + 0.1 * (scatter(particles, repetition, 4) - 1));
        };
    };
    EXPECT_EQ(evaluated(rule + "min = 0.8\nmax = 1.2\n", power(1)).verdict, ClaimVerdict::confirmed);
    EXPECT_EQ(evaluated(rule + "min = 0.8\nmax = 1.2\n", power(2)).verdict, ClaimVerdict::refuted);
}

TEST(ClaimRules, ATrendIsTheRankCorrelationWithTheLoad) {
    const std::string rule =
        "quantity = \"trend\"\ncolumn = \"frame_ms_median\"\nagainst = \"p.particles\"\nof = \"mist\"\nmin = 0.9\n";
    EXPECT_EQ(evaluated(rule, ratioOf(1)).verdict, ClaimVerdict::confirmed);
    EXPECT_EQ(evaluated(rule, ratioOf(1)).measured, 1);
    const auto falling = [](const std::string&, int particles, int) { return 1000.0 - particles; };
    EXPECT_EQ(evaluated(rule, falling).verdict, ClaimVerdict::refuted);
    const auto upAndDown = [](const std::string&, int particles, int repetition) {
        return particles == 400 ? 1.0 : particles * scatter(particles, repetition, 6);
    };
    EXPECT_EQ(evaluated(rule, upAndDown).verdict, ClaimVerdict::refuted);
    // Student's interval of alternating −1 and 1 is wider than the range of a correlation.
    const auto byTurns = [](const std::string&, int particles, int repetition) {
        return repetition % 2 ? 1.0 * particles : 1000.0 - particles;
    };
    const ClaimResult wide = evaluated(rule, byTurns);
    EXPECT_EQ(wide.verdict, ClaimVerdict::unresolved);
    EXPECT_EQ(wide.low, -1);
    EXPECT_EQ(wide.high, 1);
}

TEST(ClaimRules, SlopesAreEqualForALineOnly) {
    const std::string rule =
        "quantity = \"slopes\"\ncolumn = \"frame_ms_median\"\nagainst = \"p.particles\"\nof = \"mist\"\nmin = 0.8\nmax "
        "= "
        "1.25\n";
    const auto line = [](const std::string&, int particles, int) { return 500.0 - 0.5 * particles; };
    EXPECT_EQ(evaluated(rule, line).verdict, ClaimVerdict::confirmed);
    EXPECT_NEAR(evaluated(rule, line).measured, 1, 1e-12);
    const auto inverse = [](const std::string&, int particles, int) { return 1e5 / particles; };
    EXPECT_EQ(evaluated(rule, inverse).verdict, ClaimVerdict::refuted);
    // From 100, 400, 800: (1000 − 250)/300 = 2.5 and (250 − 125)/400 = 0.3125.
    EXPECT_NEAR(evaluated(rule, inverse).measured, 0.125, 1e-12);
}

TEST(ClaimRules, CellsThatDisagreeMakeItDependAndTheConditionIsInWords) {
    const std::string rule = "quantity = \"value\"\ncolumn = \"frame_ms_median\"\nof = \"mist\"\nmax = 10\n";
    // 6, 7, 9 and 13 ms: the mean of 8.75 would hide the last one.
    const ClaimResult result = evaluated(rule, ratioOf(1));
    EXPECT_EQ(result.verdict, ClaimVerdict::depends);
    EXPECT_EQ(result.condition, "true for particles up to 400, false from 800");
    ASSERT_EQ(result.cells.size(), 4u);
    EXPECT_EQ(std::ranges::count(result.cells, ClaimVerdict::confirmed, &ClaimCell::verdict), 3);
    EXPECT_EQ(evaluated(rule + "over = \"none\"\n", ratioOf(1)).verdict, ClaimVerdict::depends);
    const auto slow = [](const std::string&, int, int) { return 20.0; };
    EXPECT_EQ(evaluated(rule, slow).verdict, ClaimVerdict::refuted);
}

TEST(ClaimRules, ACrossoverIsNotHiddenByTheMean) {
    // From 0.8 at 100 particles to 1.15 at 800; the geometric mean of the ratios is below 1.
    const auto crossing = [](const std::string& method, int particles, int repetition) {
        const double ratio = 0.8 + 0.0005 * (particles - 100);
        return (method == "haze" ? ratio : 1) * particles * scatter(particles, repetition, method == "haze" ? 1 : 2);
    };
    const ClaimResult result = evaluated(faster, crossing);
    EXPECT_LT(result.measured, 0.97);
    EXPECT_EQ(result.verdict, ClaimVerdict::depends);
    EXPECT_EQ(result.condition, "true for particles up to 400, false from 800");
}

TEST(ClaimRules, ADisagreementByChanceIsNoCondition) {
    // All cells have equal speed: some 95 % intervals exclude 1 by chance, but hardly any with Bonferroni's correction.
    int depends = 0;
    constexpr int trials = 400;
    for (int trial = 0; trial < trials; ++trial) {
        const auto even = [&](const std::string& method, int particles, int repetition) {
            const auto stream = static_cast<std::uint32_t>(10 + 2 * trial + (method == "haze"));
            return particles * scatter(particles, repetition, stream);
        };
        depends += evaluated(faster, even).verdict == ClaimVerdict::depends;
    }
    // Two errors of 0.05/2 each at most would have to meet: 400 · 0.05² / 2 = 0.5 on average.
    EXPECT_LE(depends, 4);
}

TEST(ClaimRules, WhatNeedsNoRepetitionHoldsInAllCellsOrNone) {
    const std::string rule =
        "quantity = \"ratio\"\ncolumn = \"popping\"\nof = \"haze\"\nwith = \"mist\"\nover = \"none\"\nmax = 1\n";
    EXPECT_EQ(evaluated(rule, ratioOf(0.9)).verdict, ClaimVerdict::confirmed);
    EXPECT_EQ(evaluated(rule, ratioOf(1.1)).verdict, ClaimVerdict::refuted);
    EXPECT_TRUE(std::isnan(evaluated(rule, ratioOf(1.1)).low));
    EXPECT_EQ(evaluated(rule, [](const std::string& method, int particles,
                                 int) { return method == "haze" ? particles : 300.0; })
                  .condition,
              "true for particles up to 200, false from 400");
}

/// Rows of both methods for each seed, optionally with an invalid one. `value(method, seed)` is the metric.
files::CsvTable seedTable(int seeds, const std::function<double(bool, int)>& value, int invalidSeed = 0) {
    std::string text = "run_id,status,method,scene,seed,repetition,invalid,popping\n";
    for (const bool haze : {true, false})
        for (int seed = 1; seed <= seeds; ++seed)
            text += fmt::format("run{}{},done,{},plain,{},1,{},{}\n", haze ? "h" : "m", seed, haze ? "haze" : "mist",
                                seed, seed == invalidSeed ? "clipped" : "", value(haze, seed));
    return files::CsvTable::parseText(text, "summary.csv");
}

const std::string bySeed =
    "quantity = \"ratio\"\ncolumn = \"popping\"\nof = \"haze\"\nwith = \"mist\"\nover = \"seeds\"\nmax = 1\n";

TEST(ClaimRules, ChanceIsMeasuredOverSeedsAndPairedByThem) {
    // Clouds differ by a factor of ten; only pairs with the same cloud show that haze pops a tenth less.
    const auto value = [](bool haze, int seed) { return (haze ? 0.9 : 1) * seed * scatter(seed, 1, haze ? 7 : 8); };
    const files::CsvTable ten = seedTable(10, value);
    const ClaimResult result = evaluateRule(ruledClaim(bySeed).rule, ResultRows(ten, nullptr));
    EXPECT_EQ(result.verdict, ClaimVerdict::confirmed);
    EXPECT_NEAR(result.measured, 0.9, 0.01);
    EXPECT_LT(result.low, result.high);
    ASSERT_EQ(result.cells.size(), 1u);
    EXPECT_EQ(result.cells[0].turns, 10u);
    const files::CsvTable four = seedTable(4, value);
    const ClaimResult few = evaluateRule(ruledClaim(bySeed).rule, ResultRows(four, nullptr));
    EXPECT_EQ(few.verdict, ClaimVerdict::unresolved);
    EXPECT_EQ(few.note, "4 seeds, 5 are needed");
}

TEST(ClaimRules, InvalidRunsAreNotUsed) {
    const auto value = [](bool haze, int seed) { return seed == 3 && haze ? 1e6 : haze ? 0.9 : 1.0; };
    const files::CsvTable rows = seedTable(6, value, 3);
    const ClaimResult result = evaluateRule(ruledClaim(bySeed).rule, ResultRows(rows, nullptr));
    EXPECT_EQ(result.verdict, ClaimVerdict::confirmed);
    EXPECT_EQ(result.cells.at(0).turns, 5u);
    const files::CsvTable one = seedTable(1, value, 1);
    EXPECT_EQ(evaluateRule(ruledClaim(bySeed).rule, ResultRows(one, nullptr)).note,
              "no popping of haze in a completed run of s; invalid: clipped (1 run)");
}

TEST(ClaimRules, EachVariantOfARatioIsACellOfItsOwn) {
    // Mist in two layouts; haze is better than only one of them.
    std::string text = "run_id,status,method,scene,repetition,p.layout,frame_ms_median\n";
    for (int repetition = 1; repetition <= rulesRepetitions; ++repetition)
        for (const auto& [method, layout, ms] :
             {std::tuple("haze", "", 1.0), {"mist", "old", 2.0}, {"mist", "new", 0.5}})
            text += fmt::format("{}{}{},done,{},plain,{},{},{}\n", method, layout, repetition, method, repetition,
                                layout, ms * scatter(repetition, repetition, ms > 1 ? 1 : 2));
    const files::CsvTable rows = files::CsvTable::parseText(text, "summary.csv");
    const ClaimResult result = evaluateRule(ruledClaim(faster).rule, ResultRows(rows, nullptr));
    EXPECT_EQ(result.verdict, ClaimVerdict::depends);
    EXPECT_EQ(result.condition, "true with layout old, false with new");
}

TEST(ClaimRules, WhatBothSidesNameAlikeIsPaired) {
    const std::string paired =
        "quantity = \"ratio\"\ncolumn = \"frame_ms_median\"\nof = \"haze particles=100|800\"\n"
        "with = \"mist particles=100|800\"\nmax = 1\n";
    const ClaimResult result = evaluated(paired, ratioOf(0.9));
    EXPECT_EQ(result.verdict, ClaimVerdict::confirmed);
    ASSERT_EQ(result.cells.size(), 2u);
    EXPECT_EQ(textOf(result.cells[0].cell), "particles=100");
    // If the names differ, the pairs are crossed intentionally.
    const std::string crossed =
        "quantity = \"ratio\"\ncolumn = \"frame_ms_median\"\nof = \"haze particles=100|800\"\n"
        "with = \"mist particles=100\"\nmax = 1\n";
    EXPECT_EQ(evaluated(crossed, ratioOf(0.9)).verdict, ClaimVerdict::depends);
}

TEST(ClaimRules, ASceneCanBeNamed) {
    EXPECT_EQ(parseSelection("haze scene=plain speed=5", "of"),
              (Selection{{"method", "haze"}, {"scene", "plain"}, {"p.speed", "5"}}));
    EXPECT_EQ(textOf(parseSelection("haze scene=plain", "of")), "haze scene=plain");
    EXPECT_EQ(evaluated(faster, ratioOf(0.9)).verdict,
              evaluated("quantity = \"ratio\"\ncolumn = \"frame_ms_median\"\nof = \"haze scene=plain\"\n"
                        "with = \"mist scene=plain\"\nmax = 1\n",
                        ratioOf(0.9))
                  .verdict);
}

/// Haze takes `ratio(particles, repetition)` times as long as mist.
ValueOf ratioBy(const std::function<double(int, int)>& ratio) {
    return [=](const std::string& method, int particles, int repetition) {
        return (method == "haze" ? ratio(particles, repetition) : 1) * (5 + 0.01 * particles) *
               scatter(particles, repetition, method == "haze" ? 1 : 2);
    };
}

TEST(ClaimRules, CounterexamplesRefuteAlthoughACellIsOpen) {
    // 1.4 times as slow. In undecided cells, repetitions scatter by a factor in both directions, so the mean stays.
    const auto openAt = [](const std::vector<int>& open, double factor) {
        return ratioBy([=](int particles, int repetition) {
            const auto place = std::ranges::find(open, particles);
            if (place == open.end()) return 1.4;
            const bool up = (repetition + (place - open.begin())) % 2 == 0;
            return 1.4 * (up ? factor : 1 / factor);
        });
    };
    const ClaimResult result = evaluated(faster, openAt({800}, 2));
    EXPECT_EQ(result.verdict, ClaimVerdict::refuted);
    EXPECT_EQ(result.note, "of 4 cases, 0 confirmed, 3 refuted");
    EXPECT_TRUE(result.condition.empty());
    // Half of the cells do not suffice, although the mean is just as far outside.
    const ClaimResult half = evaluated(faster, openAt({400, 800}, 2));
    EXPECT_EQ(half.verdict, ClaimVerdict::unresolved);
    EXPECT_GT(half.low, 1.3);
    // Nor do three of four cells if the mean is undecided.
    EXPECT_EQ(evaluated(faster, openAt({800}, 50)).verdict, ClaimVerdict::unresolved);
    // Nor if the undecided cell is more likely true.
    const auto leaning = ratioBy([](int particles, int repetition) {
        return particles < 800 ? 1.4 : 0.9 * (repetition % 2 == 0 ? 1.5 : 1 / 1.5);
    });
    const ClaimResult undecided = evaluated(faster, leaning);
    EXPECT_EQ(undecided.verdict, ClaimVerdict::unresolved);
    EXPECT_GT(undecided.low, 1);
    // Only all cells together confirm the claim.
    const auto quicker = ratioBy([](int particles, int repetition) {
        return 0.7 * (particles < 800 ? 1 : repetition % 2 == 0 ? 2 : 0.5);
    });
    EXPECT_EQ(evaluated(faster, quicker).verdict, ClaimVerdict::unresolved);
    // With a cell that is certainly true, the verdict is `depends`.
    EXPECT_EQ(evaluated(faster, ratioBy([](int particles, int) { return particles == 100 ? 0.7 : 1.4; })).verdict,
              ClaimVerdict::depends);
}

/// Rows of one method over voxel edges and speeds; `value(depth, speed)`.
ClaimResult evaluatedOverEdges(const std::function<double(int, int)>& value) {
    std::string text = "run_id,status,method,scene,seed,repetition,p.depth,p.speed,p.world_edge,gaps\n";
    int id = 0;
    for (const int depth : {4, 5, 6, 7, 8})
        for (const int speed : {5, 10, 40})
            for (int seed = 1; seed <= 5; ++seed)
                text += fmt::format("run{},done,haze,plain,{},1,{},{},128,{}\n", id++, seed, depth, speed,
                                    value(depth, speed) * (1 + 0.001 * seed));
    const files::CsvTable rows = files::CsvTable::parseText(text, "summary.csv");
    return evaluateRule(ruledClaim("quantity = \"value\"\ncolumn = \"gaps\"\nof = \"haze\"\nover = \"seeds\"\n"
                                   "max = 1\nalong = \"p.voxel_edge\"\n")
                            .rule,
                        ResultRows(rows, nullptr));
}

TEST(ClaimRules, AConditionCanBeToldAlongAnAxis) {
    // Edges 8, 4, 2, 1, 0.5 m: true from 2 m on at 5 and 10 m/s, but only at 1 m and 8 m at 40 m/s.
    const ClaimResult result = evaluatedOverEdges([](int depth, int speed) {
        const double edge = 128.0 / (1 << depth);
        return (speed < 40 ? edge >= 2 : edge == 1 || edge == 8) ? 0.5 : 2;
    });
    EXPECT_EQ(result.verdict, ClaimVerdict::depends);
    EXPECT_EQ(result.condition,
              "by voxel_edge: true for 2 to 8, false for 0.5 to 1 (speed=10, speed=5); true for 1, 8, false for 0.5, 2 "
              "to 4 (speed=40)");
    EXPECT_EQ(intervalAlong(result.cells, "p.voxel_edge"),
              "true for voxel_edge 8 m, in some configurations for 1 to 4 m");
    EXPECT_EQ(intervalAlong(result.cells, "p.particles"), "");
    EXPECT_EQ(evaluatedOverEdges([](int, int) { return 0.5; }).condition, "");
    const ClaimResult bySpeed = evaluatedOverEdges([](int, int speed) { return speed < 40 ? 0.5 : 2; });
    EXPECT_EQ(intervalAlong(bySpeed.cells, "p.voxel_edge"),
              "true for no voxel_edge in every configuration, in some configurations for 0.5 to 8 m");
    // Values equal to their limit are undecided.
    EXPECT_EQ(evaluatedOverEdges([](int depth, int) { return depth == 4   ? 0.5
                                                             : depth == 5 ? 0.997
                                                                          : 2; }).condition,
              "by voxel_edge: true for 8, false for 0.5 to 2, open for 4 (speed=10, speed=40, speed=5)");
}

TEST(ClaimRules, AMatchedRatioIsTakenWhereTheOtherColumnIsTheSame) {
    // Gaps halve when the number of quads doubles; haze needs a quarter of the quads of mist for the same gaps.
    std::string text = "run_id,status,method,scene,seed,repetition,p.particles,primitives_median,gaps\n";
    for (int seed = 1; seed <= 6; ++seed)
        for (const int particles : {100, 200, 400, 800, 1600, 3200})
            for (const bool haze : {true, false})
                text +=
                    fmt::format("{}{}{},done,{},plain,{},1,{},{},{}\n", haze, seed, particles, haze ? "haze" : "mist",
                                seed, particles, particles, scatter(seed, 1, 3) * (haze ? 25.0 : 100.0) / particles);
    const files::CsvTable rows = files::CsvTable::parseText(text, "summary.csv");
    const std::string rule =
        "quantity = \"matched\"\ncolumn = \"primitives_median\"\nmatch = \"gaps\"\nagainst = \"p.particles\"\n"
        "of = \"haze\"\nwith = \"mist\"\nover = \"seeds\"\nmax = 0.5\n";
    const ClaimResult result = evaluateRule(ruledClaim(rule).rule, ResultRows(rows, nullptr));
    EXPECT_EQ(result.verdict, ClaimVerdict::confirmed);
    EXPECT_NEAR(result.measured, 0.25, 0.002);
    // With 1600 and 3200 particles, haze has fewer gaps than mist ever reaches.
    EXPECT_EQ(result.cells.size(), 4u);
    EXPECT_EQ(result.note, "12 runs left out: no run of mist has the same gaps");
}

const std::string slowed =
    "[[claim.control]]\nwhy = \"swapped\"\ngives = \"refuted\"\nof = \"mist\"\nwith = \"haze\"\n";

ClaimResult controlled(const std::string& rule, const ValueOf& value) {
    const files::CsvTable rows = table(value);
    return evaluateWithControls(ruledClaim(rule),
                                [&](const Rule& each) { return evaluateRule(each, ResultRows(rows, nullptr)); });
}

TEST(ClaimControls, OneThatTurnsLeavesTheVerdict) {
    const ClaimResult result = controlled(faster + slowed, ratioOf(0.9));
    EXPECT_EQ(result.verdict, ClaimVerdict::confirmed);
    EXPECT_EQ(result.control, ControlState::turned);
    EXPECT_EQ(result.controlNote, "refuted, as expected (1.111: swapped)");
    ASSERT_EQ(result.controls.size(), 1u);
    EXPECT_EQ(result.controls[0].verdict, ClaimVerdict::refuted);
    EXPECT_NEAR(result.controls[0].measured, 1 / 0.9, 1e-3);
}

TEST(ClaimControls, ARuleThatCannotFailIsUntestable) {
    // Anything up to 2 is "faster" to this rule: its control passes too.
    const std::string lax = faster.substr(0, faster.find("max")) + "max = 2\n";
    const ClaimResult result = controlled(lax + slowed, ratioOf(0.9));
    EXPECT_EQ(result.verdict, ClaimVerdict::untestable);
    EXPECT_EQ(result.control, ControlState::notTurned);
    EXPECT_EQ(result.note, "measured: confirmed; the control did not reverse it");
    EXPECT_EQ(result.controlNote, "confirmed, expected: refuted (1.111: swapped)");
}

TEST(ClaimControls, ARefutedClaimNeedsAControlThatConfirms) {
    EXPECT_EQ(controlled(faster + slowed, ratioOf(1.1)).verdict, ClaimVerdict::untestable);
    const std::string other =
        "[[claim.control]]\nwhy = \"swapped\"\ngives = \"confirmed\"\nof = \"mist\"\nwith = \"haze\"\n";
    const ClaimResult result = controlled(faster + other, ratioOf(1.1));
    EXPECT_EQ(result.verdict, ClaimVerdict::refuted);
    EXPECT_EQ(result.control, ControlState::turned);
    EXPECT_EQ(controlled(faster, ratioOf(0.9)).verdict, ClaimVerdict::untestable);
}

TEST(ClaimControls, RunsThatAreMissingAreSaid) {
    const std::string elsewhere =
        "[[claim.control]]\nwhy = \"slower\"\ngives = \"refuted\"\nof = \"haze sort=quick\"\nwith = \"mist\"\n";
    const ClaimResult result = controlled(faster + elsewhere, ratioOf(0.9));
    EXPECT_EQ(result.verdict, ClaimVerdict::confirmed);
    EXPECT_EQ(result.control, ControlState::notRun);
}

TEST(ClaimRules, WhatIsMissingIsNamed) {
    const auto none = [](const std::string&, int, int) { return std::nan(""); };
    EXPECT_EQ(evaluated(faster, none).verdict, ClaimVerdict::notTested);
    EXPECT_EQ(evaluated(faster, none).note, "no frame_ms_median of haze in a completed run of s");
    const Claim untestable =
        parseClaims("[[claim]]\nid = \"X\"\ntext = \"t\"\nquantity = \"none\"\nmissing = \"no numbers\"", "c").at(0);
    EXPECT_EQ(untestable.missing, "no numbers");
}

}  // namespace
}  // namespace dustbench::claims
