#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <functional>
#include <iterator>

#include "bench/claims/claim_ledger.h"
#include "bench/claims/printed_numbers.h"
#include "bench/results/run_record.h"
#include "bench/suite/paper.h"
#include "bench/suite/suite.h"
#include "methods/contract/errors.h"
#include "methods/kit/maths/philox.h"
#include "source_folder.h"

namespace dustbench::bench {
namespace {

constexpr int repetitions = 6;

/// ms of a method in a world: `value(method, particles, repetition)`; empty for a failed run.
using Value = std::function<double(const std::string&, int, int)>;

/// Two methods, three loads, six repetitions; `haze` has a parameter of its own.
files::CsvTable table(const Value& value) {
    std::string text =
        "run_id,status,method,scene,repetition,p.particles,p.sort,frame_ms_median,draw_ms_median,popping\n";
    int id = 0;
    for (const char* method : {"haze", "mist"})
        for (const int particles : {100, 200, 400, 800})
            for (int repetition = 1; repetition <= repetitions; ++repetition) {
                const double ms = value(method, particles, repetition);
                text +=
                    fmt::format("run{},{},{},plain,{},{},{},{},{},{}\n", id++, std::isfinite(ms) ? "done" : "failed",
                                method, repetition, particles, method[0] == 'h' ? "radix" : "", ms, 0.8 * ms,
                                repetition == 1 ? fmt::format("{}", ms) : "");
            }
    return files::CsvTable::parseText(text, "summary.csv");
}

/// Scatter of about one percent; deterministic.
double scatter(int particles, int repetition, std::uint32_t stream) {
    const auto words = maths::randomWords(
        9, stream, static_cast<std::uint64_t>(particles) * 100 + static_cast<std::uint64_t>(repetition));
    return 1 + 0.01 * static_cast<double>(maths::unitFloat(words[0]) + maths::unitFloat(words[1]) - 1);
}

Claim claimOf(const std::string& rule) {
    return parseClaims("[[claim]]\nid = \"X\"\ntext = \"t\"\nsuite = \"s\"\n" + rule, "claims.toml").at(0);
}

ClaimResult judged(const std::string& rule, const Value& value) {
    const files::CsvTable rows = table(value);
    return judgeClaim(claimOf(rule), ResultRows(rows, nullptr));
}

/// Haze takes `ratio` times as long as mist in every world.
Value ratioOf(double ratio) {
    return [ratio](const std::string& method, int particles, int repetition) {
        const bool haze = method == "haze";
        return (haze ? ratio : 1) * (5 + 0.01 * particles) * scatter(particles, repetition, haze ? 1 : 2);
    };
}

const std::string faster =
    "quantity = \"ratio\"\ncolumn = \"frame_ms_median\"\nof = \"haze\"\nwith = \"mist\"\nmax = 1\n";

TEST(ClaimRules, ARatioTurnsRoundWithTheTimes) {
    const ClaimResult holds = judged(faster, ratioOf(0.9));
    EXPECT_EQ(holds.verdict, ClaimVerdict::confirmed);
    EXPECT_NEAR(holds.measured, 0.9, 0.01);
    EXPECT_LT(holds.low, holds.measured);
    EXPECT_GT(holds.high, holds.measured);
    EXPECT_EQ(holds.runs.size(), 48u);
    // The same table with the method names swapped.
    const Value value = ratioOf(0.9);
    const ClaimResult reversed = judged(faster, [&](const std::string& method, int particles, int repetition) {
        return value(method == "haze" ? "mist" : "haze", particles, repetition);
    });
    EXPECT_EQ(reversed.verdict, ClaimVerdict::refuted);
    EXPECT_EQ(judged(faster, ratioOf(1)).verdict, ClaimVerdict::unresolved);
}

TEST(ClaimRules, ARatioPairsTheSameWorldAndRepetitionAlone) {
    // Rounds drift by a factor of three; only pairs within a round reveal the small difference.
    const auto drifting = [](const std::string& method, int particles, int repetition) {
        return (method == "haze" ? 0.97 : 1) * particles * (1 + repetition % 3);
    };
    const ClaimResult result = judged(faster, drifting);
    EXPECT_EQ(result.verdict, ClaimVerdict::confirmed);
    EXPECT_NEAR(result.low, 0.97, 1e-9);
    EXPECT_NEAR(result.high, 0.97, 1e-9);
}

TEST(ClaimRules, AFindingIsJudgedByItsOwnInterval) {
    const Claim claim = parseClaims(
                            "[[claim]]\nid = \"X\"\ntext = \"t\"\nquantity = \"finding\"\nexperiment = \"sampling\"\n"
                            "column = \"acceptance\"\nmin = 0.53\n",
                            "claims.toml")
                            .at(0);
    const auto judgedAt = [&](double value) {
        StoredFinding finding;
        finding.experiment = "sampling";
        finding.quantity = "acceptance";
        finding.value = value;
        finding.low = value - 0.01;
        finding.high = value + 0.01;
        return judgeFinding(claim, {finding}).verdict;
    };
    EXPECT_EQ(judgedAt(0.55), ClaimVerdict::confirmed);
    EXPECT_EQ(judgedAt(0.51), ClaimVerdict::refuted);
    EXPECT_EQ(judgedAt(0.535), ClaimVerdict::unresolved);
    const ClaimResult untested = judgeFinding(claim, {});
    EXPECT_EQ(untested.verdict, ClaimVerdict::notTested);
    EXPECT_EQ(untested.note, "experiments.csv has no acceptance of the experiment 'sampling'");
}

TEST(ClaimRules, FewerRepetitionsThanSixResolveNothing) {
    const ClaimResult result = judged(faster, [](const std::string& method, int particles, int repetition) {
        return repetition == 2 ? std::nan("") : (method == "haze" ? 0.5 : 1) * particles;
    });
    EXPECT_EQ(result.verdict, ClaimVerdict::unresolved);
    EXPECT_EQ(result.note, "5 complete repetitions, 6 are needed");
}

TEST(ClaimRules, AShareIsOfTheSumOfItsParts) {
    const auto rule = [](double minimum) {
        return fmt::format(
            "quantity = \"share\"\ncolumn = \"frame_ms_median\"\nparts = [\"draw_ms_median\"]\nof = \"mist\"\nmin = "
            "{}\n",
            minimum);
    };
    EXPECT_EQ(judged(rule(0.5), ratioOf(1)).verdict, ClaimVerdict::confirmed);
    EXPECT_EQ(judged(rule(0.9), ratioOf(1)).verdict, ClaimVerdict::refuted);
    EXPECT_NEAR(judged(rule(0.9), ratioOf(1)).measured, 0.8, 1e-9);
}

TEST(ClaimRules, AGrowthIsFromTheMinimumLoadToTheMaximum) {
    const std::string rule =
        "quantity = \"growth\"\ncolumn = \"frame_ms_median\"\nagainst = \"p.particles\"\nof = \"mist\"\nmin = ";
    const ClaimResult result = judged(rule + "2\n", ratioOf(1));
    EXPECT_NEAR(result.measured, 13.0 / 6, 0.05);
    EXPECT_EQ(result.verdict, ClaimVerdict::confirmed);
    EXPECT_EQ(judged(rule + "3\n", ratioOf(1)).verdict, ClaimVerdict::refuted);
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
    EXPECT_EQ(judged(rule, power(1)).verdict, ClaimVerdict::confirmed);
    EXPECT_NEAR(judged(rule, power(1)).measured, 1, 0.02);
    EXPECT_EQ(judged(rule, power(2)).verdict, ClaimVerdict::refuted);
}

TEST(ClaimRules, AnExponentIsThatOfTheFittedCurve) {
    const std::string rule =
        "quantity = \"exponent\"\ncolumn = \"frame_ms_median\"\nagainst = \"p.particles\"\nof = \"mist\"\n";
    const auto power = [](double k) {
        return [k](const std::string&, int particles, int repetition) {
            return (1 + 0.01 * std::pow(particles, k)) * (1 + 0.1 * (scatter(particles, repetition, 4) - 1));
        };
    };
    EXPECT_EQ(judged(rule + "min = 0.8\nmax = 1.2\n", power(1)).verdict, ClaimVerdict::confirmed);
    EXPECT_EQ(judged(rule + "min = 0.8\nmax = 1.2\n", power(2)).verdict, ClaimVerdict::refuted);
}

TEST(ClaimRules, AValueHasAnIntervalOverRepetitionsOrTheRangeOfTheCells) {
    const std::string rule = "quantity = \"value\"\ncolumn = \"frame_ms_median\"\nof = \"mist\"\nmax = 10\n";
    EXPECT_EQ(judged(rule, ratioOf(1)).verdict, ClaimVerdict::confirmed);  // 6, 7, 9 and 13: 8.75 on average
    EXPECT_EQ(judged(rule + "exact = true\n", ratioOf(1)).verdict, ClaimVerdict::unresolved);
    EXPECT_EQ(judged(rule + "exact = true\n", ratioOf(1)).note, "true in 3 of 4 cells: not with particles=800");
    const auto slow = [](const std::string&, int, int) { return 20.0; };
    EXPECT_EQ(judged(rule, slow).verdict, ClaimVerdict::refuted);
}

TEST(ClaimRules, ExactRatiosNeedOneRepetitionAndHoldInAllCellsOrNone) {
    const std::string rule =
        "quantity = \"ratio\"\ncolumn = \"popping\"\nof = \"haze\"\nwith = \"mist\"\nexact = true\nmax = 1\n";
    EXPECT_EQ(judged(rule, ratioOf(0.9)).verdict, ClaimVerdict::confirmed);
    EXPECT_EQ(judged(rule, ratioOf(1.1)).verdict, ClaimVerdict::refuted);
    EXPECT_EQ(
        judged(rule, [](const std::string& method, int particles, int) { return method == "haze" ? particles : 300.0; })
            .note,
        "true in 2 of 4 cells: not with particles=400; particles=800");
}

TEST(ClaimRules, WhatIsMissingIsNamed) {
    const auto none = [](const std::string&, int, int) { return std::nan(""); };
    EXPECT_EQ(judged(faster, none).verdict, ClaimVerdict::notTested);
    EXPECT_EQ(judged(faster, none).note, "no frame_ms_median of haze in a run of s that is done");
    const Claim untestable =
        parseClaims("[[claim]]\nid = \"X\"\ntext = \"t\"\nquantity = \"none\"\nmissing = \"no numbers\"", "c").at(0);
    const files::CsvTable rows = table(none);
    EXPECT_EQ(judgeClaim(untestable, ResultRows(rows, nullptr)).note, "no numbers");
}

TEST(Claims, MistakesNameTheirLine) {
    const auto message = [](const std::string& rule) {
        try {
            (void)claimOf(rule);
            return std::string("no error");
        } catch (const InputError& error) {
            return std::string(error.what());
        }
    };
    const std::string start = "quantity = \"value\"\nof = \"mist\"\n";
    EXPECT_NE(message(start + "column = \"frame_ms_meridian\"").find("'frame_ms_median'"), std::string::npos);
    EXPECT_NE(message(start + "column = \"fps_avg\"").find("neither 'min' nor 'max'"), std::string::npos);
    EXPECT_NE(message(start + "column = \"fps_avg\"\nmin = 2\nmax = 1").find("above"), std::string::npos);
    EXPECT_NE(message("quantity = \"mean\"").find("claims.toml:5"), std::string::npos);
    EXPECT_NE(message(start + "column = \"fps_avg\"\nmin = 2\nexpect = 1").find("expect"), std::string::npos);
}

TEST(Claims, ThoseOfEveryPaperCanBeReadAndTheirSuitesAreThePapers) {
    for (const std::string& id : listPapers()) {
        const Paper paper = loadPaper(id);
        for (const Claim& claim : loadClaims(id))
            EXPECT_TRUE(claim.suite.empty() || std::ranges::count(paper.suites, claim.suite) == 1) << claim.id;
    }
    const auto empty = files::CsvTable::parseText("run_id,status,repetition\n", "summary.csv");
    for (const JudgedClaim& judged : judgeClaims("carr2006", empty)) {
        EXPECT_EQ(judged.result.verdict, ClaimVerdict::notTested) << judged.claim.id;
        EXPECT_NE(judged.result.note, "") << judged.claim.id;
    }
}

TEST(Claims, ReadTheRunsOfTheirSuiteAndNoOthers) {
    // Both octrees of the comparison's quick form, by their real names; the recursive one takes half the time.
    const Suite suite = loadSuite("carr2006-compare", true);
    std::string text = "run_id,status,method,repetition,p.particles,p.layout,build_ms_median\n";
    for (const bool isSuites : {true, false})
        for (const PlannedRun& cell : suite.cells)
            for (int repetition = 1; repetition <= repetitions; ++repetition) {
                if (!cell.spec.parameters.contains("layout")) continue;
                const double ms = (cell.spec.method == "octree_recursive") == isSuites ? 1 : 2;
                text += fmt::format("{}{},done,{},{},{},{},{}\n", runId(inRepetition(cell.spec, repetition)),
                                    isSuites ? "" : "x", cell.spec.method, repetition,
                                    cell.spec.parameters.at("particles"), cell.spec.parameters.at("layout"), ms);
            }
    for (const JudgedClaim& judged : judgeClaims("carr2006", files::CsvTable::parseText(text, "summary.csv")))
        if (judged.claim.id == "R2a") {
            EXPECT_EQ(judged.result.verdict, ClaimVerdict::confirmed) << judged.result.note;
            EXPECT_NEAR(judged.result.measured, 0.5, 1e-9);
        }
    const std::string csv = claimsCsv(judgeClaims("carr2006", files::CsvTable::parseText(text, "summary.csv")));
    EXPECT_EQ(files::CsvTable::parseText(csv, "claims.csv").cell(1, "verdict"), "confirmed");
}

TEST(Claims, EveryColumnOfTheCsvIsDescribed) {
    std::ifstream file(std::string(DUSTBENCH_SOURCE_DIR) + "/reports/SCHEMA.md");
    const std::string text(std::istreambuf_iterator<char>(file), {});
    const std::size_t begin = text.find("\n## claims.csv\n"), end = text.find("\n## ", begin + 1);
    ASSERT_NE(begin, std::string::npos);
    const auto ledger = files::CsvTable::parseText(claimsCsv({}), "claims.csv");
    for (const std::string& column : ledger.header())
        EXPECT_NE(text.substr(begin, end - begin).find("`" + column + "`"), std::string::npos) << column;
}

TEST(PublishedNumbers, StandBesideTheSumOfOurColumns) {
    const std::string head = "what,suite,of,columns,published,formula\n";
    const auto summary = files::CsvTable::parseText(
        "run_id,status,method,scene,repetition,p.particles,cpu_bytes,gpu_bytes\n"
        "a,done,haze,plain,1,100,30,12\nb,failed,haze,plain,1,200,7,7\n",
        "summary.csv");
    const TextRows table =
        tabulatePrinted(files::CsvTable::parseText(head + "small,,haze particles=100,cpu_bytes gpu_bytes,about 40,40\n"
                                                          "failed,,haze particles=200,cpu_bytes,7,7\n",
                                                   "numbers.csv"),
                        summary);
    ASSERT_EQ(table.rows.size(), 2u);
    EXPECT_EQ(table.rows[0], (std::vector<std::string>{"small", "about 40", "40", "42", "1.050"}));
    EXPECT_EQ(table.rows[1], (std::vector<std::string>{"failed", "7", "7", "", ""}));
    for (const char* wrong : {"x,,haze,cpu_byte,1,1\n", "x,,haze =3,cpu_bytes,1,1\n"})
        EXPECT_THROW((void)tabulatePrinted(files::CsvTable::parseText(head + wrong, "p.csv"), summary), InputError);
}

}  // namespace
}  // namespace dustbench::bench
