#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <regex>
#include <set>

#include "bench/claims/claim_ledger.h"
#include "bench/claims/claim_verdict.h"
#include "bench/results/run_record.h"
#include "bench/suite/made_paper.h"
#include "bench/suite/paper.h"
#include "bench/suite/suite.h"
#include "methods/contract/errors.h"
#include "source_folder.h"

namespace dustbench::claims {
namespace {

constexpr int repetitions = 6;

Claim claimOf(const std::string& rule) {
    return parseClaims("[[claim]]\nid = \"X\"\ntext = \"t\"\nsuite = \"s\"\nreason = \"r\"\n" + rule, "claims.toml")
        .at(0);
}

TEST(Claims, ValuesAreWrittenToBeRead) {
    Rule bytes, ratio;
    bytes.quantity = Quantity::value;
    bytes.column = "cpu_bytes";
    ratio.quantity = Quantity::ratio;
    ratio.column = "cpu_bytes";
    EXPECT_EQ(bytes.textOf(2'175'000), "2.175 MB");
    EXPECT_EQ(ratio.textOf(2'175'000), "2175000");
    EXPECT_EQ(ratio.textOf(-12345.6), "-12346");
    EXPECT_EQ(ratio.textOf(1.28746), "1.287");
    EXPECT_EQ(ratio.textOf(std::nan("")), "");
    bytes.per = "primitives_median";
    EXPECT_EQ(bytes.textOf(28), "28") << "bytes of each are few";
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
    EXPECT_NE(message("quantity = \"mean\"").find("claims.toml:6"), std::string::npos);
    EXPECT_NE(message(start + "column = \"fps_avg\"\nmin = 2\nexpect = 1").find("expect"), std::string::npos);
}

TEST(Claims, ThoseOfEveryPaperCanBeReadAndAreNotTestedWithoutRuns) {
    for (const std::string& id : suite::listPapers()) EXPECT_NO_THROW((void)loadClaims(id)) << id;
    const auto empty = files::CsvTable::parseText("run_id,status,repetition\n", "summary.csv");
    for (const EvaluatedClaim& evaluated : evaluateClaims("carr2006", empty)) {
        EXPECT_EQ(evaluated.result.verdict, ClaimVerdict::notTested) << evaluated.claim.id;
        EXPECT_NE(evaluated.result.note, "") << evaluated.claim.id;
    }
}

TEST(Claims, EachHasAControlAndAReasonForItsRange) {
    for (const std::string& id : suite::listPapers())
        for (const Claim& claim : loadClaims(id)) {
            if (claim.rule.quantity == Quantity::none) continue;
            EXPECT_FALSE(claim.controls.empty()) << id << " " << claim.id << " has no [[claim.control]]";
            EXPECT_GT(claim.reason.size(), 3u) << id << " " << claim.id;
            if (claim.rule.quantity != Quantity::finding) continue;
            EXPECT_FALSE(claim.rule.name.empty()) << id << " " << claim.id << ": its quantity has no name";
        }
}

TEST(Claims, AllThatThePapersClaimStandInTheLedger) {
    std::set<int> numbers;
    for (const std::string& id : suite::listPapers())
        for (const Claim& claim : loadClaims(id)) {
            if (claim.id[0] == 'R') numbers.insert(std::atoi(claim.id.c_str() + 1));
        }
    for (int number = 1; number <= 34; ++number) EXPECT_TRUE(numbers.contains(number)) << "R" << number;
}

/// The entries that a text mentions: `R5a`, `R12`.
std::set<std::string> entriesIn(const std::string& text) {
    std::set<std::string> found;
    const std::regex entry("\\bR[0-9]+[a-z]*\\b");
    for (std::sregex_iterator each(text.begin(), text.end(), entry), end; each != end; ++each)
        found.insert(each->str());
    return found;
}

TEST(Claims, StandBesideTheSentencesOfTheirPaper) {
    std::ifstream file(suite::paperFile("carr2006", "README.md"));
    const std::set<std::string> named = entriesIn({std::istreambuf_iterator<char>(file), {}});
    std::set<std::string> ids, numbers;
    for (const Claim& claim : loadClaims("carr2006")) {
        ids.insert(claim.id);
        numbers.insert(claim.id.substr(0, claim.id.find_first_not_of("0123456789", 1)));
        const bool isOurs = claim.id.ends_with("f");
        EXPECT_TRUE(isOurs || named.contains(claim.id)) << claim.id << " belongs to no sentence of the paper";
        if (isOurs) {
            EXPECT_TRUE(ids.contains(claim.id.substr(0, claim.id.size() - 1)))
                << claim.id << " has no entry as printed";
        }
    }
    for (const std::string& name : named) EXPECT_TRUE(ids.contains(name) || numbers.contains(name)) << name;
}

TEST(Claims, NeedWhatTheirPaperMeasures) {
    const suite::MadePaper paper(
        "suites = [\"mud-loads\"]\nexperiments = [\"sampling\"]\ncontrols = [\"mud-known\"]\n");
    /// The error message for a claim with this rule and this control; empty if there is none.
    const auto faultOf = [&](const std::string& rule, const std::string& control) -> std::string {
        paper.write("claims.toml", "[[claim]]\nid = \"M1\"\ntext = \"t\"\nreason = \"r\"\nmin = 1\n" + rule +
                                       "[[claim.control]]\nwhy = \"w\"\ngives = \"refuted\"\n" + control);
        try {
            (void)loadClaims("mud");
        } catch (const InputError& error) {
            return error.what();
        }
        return "";
    };
    const auto runs = [](const std::string& suite) {
        return "quantity = \"value\"\nof = \"billboard\"\ncolumn = \"fps_avg\"\nsuite = \"" + suite + "\"\n";
    };
    const auto finding = [](const std::string& experiment) {
        return "quantity = \"finding\"\ncolumn = \"c\"\nexperiment = \"" + experiment + "\"\n";
    };
    EXPECT_EQ(faultOf(runs("mud-loads"), "suite = \"mud-known\"\n"), "");
    EXPECT_EQ(faultOf(finding("sampling"), "column = \"d\"\n"), "");
    EXPECT_THAT(faultOf(runs("mud-known"), "of = \"mist\"\n"),
                testing::AllOf(
                    testing::HasSubstr("claims.toml:1: claim M1"),
                    testing::EndsWith("the suite 'mud-known' is not in the paper's paper.toml, which has mud-loads")));
    EXPECT_THAT(
        faultOf(runs("mud-loads"), "suite = \"mud-lots\"\n"),
        testing::EndsWith("the suite 'mud-lots' is not in the paper's paper.toml, which has mud-loads, mud-known"));
    EXPECT_THAT(faultOf(finding("detail"), "column = \"d\"\n"),
                testing::EndsWith("the experiment 'detail' is not in the paper's paper.toml, which has sampling"));
}

TEST(Claims, ReadTheRunsOfTheirSuiteAndNoOthers) {
    // Both octrees of the suite's quick run, with their real names; the recursive one takes half the time.
    const suite::Suite suite = suite::loadSuite("carr2006-depth", true);
    std::string text = "run_id,status,method,repetition,p.particles,p.mode,p.depth,build_ms_median\n";
    for (const bool isSuites : {true, false})
        for (const suite::PlannedRun& cell : suite.cells)
            for (int repetition = 1; repetition <= repetitions; ++repetition) {
                if (!cell.spec.parameters.contains("mode")) continue;
                const double share = (cell.spec.method == "octree_recursive") == isSuites ? 1 : 2;
                const double ms = share * std::stod(cell.spec.parameters.at("particles"));
                text += fmt::format("{}{},done,{},{},{},{},{},{}\n",
                                    results::runId(suite::inRepetition(cell.spec, repetition)), isSuites ? "" : "x",
                                    cell.spec.method, repetition, cell.spec.parameters.at("particles"),
                                    cell.spec.parameters.at("mode"), cell.spec.parameters.at("depth"), ms);
            }
    for (const EvaluatedClaim& evaluated : evaluateClaims("carr2006", files::CsvTable::parseText(text, "summary.csv")))
        if (evaluated.claim.id == "R2a") {
            EXPECT_EQ(evaluated.result.verdict, ClaimVerdict::confirmed) << evaluated.result.note;
            EXPECT_EQ(evaluated.result.control, ControlState::turned) << evaluated.result.controlNote;
            EXPECT_NEAR(evaluated.result.measured, 0.5, 1e-9);
        }
    const auto csv = files::CsvTable::parseText(
        claimsCsv(evaluateClaims("carr2006", files::CsvTable::parseText(text, "summary.csv"))), "claims.csv");
    for (std::size_t row = 0; row < csv.rows(); ++row)
        if (csv.cell(row, "id") == "R2a") {
            EXPECT_EQ(csv.cell(row, "verdict"), "confirmed");
        }
}

TEST(Claims, OfTheDeviceSaySo) {
    const std::string head = "[[claim]]\nid = \"X\"\ntext = \"t\"\nquantity = \"none\"\nmissing = \"m\"\n";
    EXPECT_THROW((void)parseClaims(head + "device = true\n", "claims.toml"), InputError) << "it has no verdict";
    EvaluatedClaim evaluated;
    evaluated.result.verdict = ClaimVerdict::refuted;
    EXPECT_EQ(verdictText(evaluated), "refuted");
    evaluated.claim = claimOf(
        "device = true\nquantity = \"value\"\ncolumn = \"fps_avg\"\nof = \"haze\"\nmin = 1\n"
        "[[claim.control]]\nwhy = \"w\"\ngives = \"refuted\"\nof = \"fog\"\n");
    EXPECT_EQ(verdictText(evaluated), "refuted on this device");
    EXPECT_EQ(tabulate({evaluated}).rows.at(0).at(1), "refuted on this device");
    const auto csv = files::CsvTable::parseText(claimsCsv({evaluated}), "claims.csv");
    EXPECT_EQ(csv.cell(0, "verdict"), "refuted");
    EXPECT_EQ(csv.cell(0, "verdict_text"), "refuted on this device");
    evaluated.result.verdict = ClaimVerdict::untestable;
    EXPECT_EQ(verdictText(evaluated), "untestable");
}

TEST(Claims, OfTheDeviceAreToldForEachMachine) {
    const auto told = [](bool device, const std::vector<ClaimVerdict>& ofMachines) {
        EvaluatedClaim evaluated;
        evaluated.claim.device = device;
        evaluated.result.verdict = ClaimVerdict::unresolved;
        tellByMachine(evaluated, ofMachines);
        return verdictText(evaluated) + "; " + evaluated.result.condition;
    };
    using enum ClaimVerdict;
    EXPECT_EQ(told(true, {confirmed, refuted}), "depends; confirmed on machine 1, refuted on machine 2");
    EXPECT_EQ(told(true, {confirmed, notTested}),
              "confirmed on this device; confirmed on machine 1, not-tested on machine 2");
    EXPECT_EQ(told(true, {confirmed}), "unresolved on this device; ");
    EXPECT_EQ(told(false, {confirmed, refuted}), "unresolved; ");
    EXPECT_EQ(told(true, {notTested, notTested}), "unresolved on this device; ");
}

TEST(Claims, ThatDependOnANumberSayWhereTheyAreTrue) {
    EvaluatedClaim evaluated;
    evaluated.claim.rule.along = "p.voxel_edge";
    const auto cell = [](const char* edge, ClaimVerdict verdict) {
        ClaimCell made;
        made.cell = {{"p.voxel_edge", edge}};
        made.verdict = verdict;
        return made;
    };
    evaluated.result.verdict = ClaimVerdict::depends;
    evaluated.result.cells = {cell("4", ClaimVerdict::confirmed), cell("2", ClaimVerdict::confirmed),
                              cell("1", ClaimVerdict::refuted)};
    EXPECT_EQ(verdictText(evaluated), "depends: true for voxel_edge 2 to 4 m");
    evaluated.result.verdict = ClaimVerdict::refuted;
    EXPECT_EQ(verdictText(evaluated), "refuted");
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
        "run_id,status,method,scene,repetition,p.particles,cpu_bytes,gpu_bytes,fps_avg\n"
        "a,done,haze,plain,1,100,30,12,83.06441630751632\nb,failed,haze,plain,1,200,7,7,\n",
        "summary.csv");
    const suite::TextRows table =
        tabulatePrinted(files::CsvTable::parseText(head + "small,,haze particles=100,cpu_bytes gpu_bytes,about 40,40\n"
                                                          "failed,,haze particles=200,cpu_bytes,7,7\n"
                                                          "rate,,haze particles=100,fps_avg,++,\n",
                                                   "numbers.csv"),
                        summary);
    ASSERT_EQ(table.rows.size(), 3u);
    EXPECT_EQ(table.rows[2], (std::vector<std::string>{"rate", "++", "", "83.06", ""}));
    EXPECT_EQ(table.rows[0], (std::vector<std::string>{"small", "about 40", "40", "42", "1.050"}));
    EXPECT_EQ(table.rows[1], (std::vector<std::string>{"failed", "7", "7", "", ""}));
    for (const char* wrong : {"x,,haze,cpu_byte,1,1\n", "x,,haze =3,cpu_bytes,1,1\n"})
        EXPECT_THROW((void)tabulatePrinted(files::CsvTable::parseText(head + wrong, "p.csv"), summary), InputError);
}

// Claims that are decided by the findings of experiments, without runs.

TEST(ClaimFindings, AreJudgedByTheirOwnInterval) {
    const Claim claim = parseClaims(
                            "[[claim]]\nid = \"X\"\ntext = \"t\"\nquantity = \"finding\"\nexperiment = \"sampling\"\n"
                            "column = \"acceptance\"\nmin = 0.53\nreason = \"r\"\n",
                            "claims.toml")
                            .at(0);
    const auto evaluatedAt = [&](double value) {
        StoredFinding finding;
        finding.experiment = "sampling";
        finding.quantity = "acceptance";
        finding.value = value;
        finding.low = value - 0.01;
        finding.high = value + 0.01;
        return evaluateFinding(claim.rule, {finding}).verdict;
    };
    EXPECT_EQ(evaluatedAt(0.55), ClaimVerdict::confirmed);
    EXPECT_EQ(evaluatedAt(0.51), ClaimVerdict::refuted);
    EXPECT_EQ(evaluatedAt(0.535), ClaimVerdict::unresolved);
    const ClaimResult untested = evaluateFinding(claim.rule, {});
    EXPECT_EQ(untested.verdict, ClaimVerdict::notTested);
    EXPECT_EQ(untested.note, "experiments.csv has no acceptance of the experiment 'sampling'");
}

TEST(ClaimFindings, OfSeveralShapesAreCells) {
    const Claim claim = parseClaims(
                            "[[claim]]\nid = \"X\"\ntext = \"t\"\nquantity = \"finding\"\nexperiment = \"sampling\"\n"
                            "column = \"kept_car|kept_bunny\"\nmin = 0.9\nreason = \"r\"\n",
                            "claims.toml")
                            .at(0);
    const auto found = [](const char* quantity, double value, double half, std::int64_t samples) {
        StoredFinding finding;
        finding.experiment = "sampling";
        finding.quantity = quantity;
        finding.value = value;
        finding.low = value - half;
        finding.high = value + half;
        finding.samples = samples;
        return finding;
    };
    const auto evaluatedAt = [&](double car, double bunny, double half, std::int64_t samples) {
        return evaluateFinding(claim.rule,
                               {found("kept_bunny", bunny, half, samples), found("kept_car", car, half, samples)});
    };
    EXPECT_EQ(evaluatedAt(0.95, 0.99, 0.01, 5).verdict, ClaimVerdict::confirmed);
    EXPECT_EQ(evaluatedAt(0.80, 0.85, 0.01, 5).verdict, ClaimVerdict::refuted);
    EXPECT_EQ(evaluatedAt(0.95, 0.905, 0.01, 5).note, "of 2 cases, 1 confirmed, 0 refuted");
    const ClaimResult mixed = evaluatedAt(0.95, 0.80, 0.01, 5);
    EXPECT_EQ(mixed.verdict, ClaimVerdict::depends);
    EXPECT_EQ(mixed.condition, "true for finding kept_car, false with kept_bunny");
    EXPECT_NEAR(mixed.measured, 0.875, 1e-12);
    // Two cells widen an interval by 1.14 for many samples, and by 1.44 for three.
    EXPECT_EQ(evaluatedAt(0.95, 0.889, 0.01, 3).verdict, ClaimVerdict::unresolved);
    EXPECT_EQ(evaluatedAt(0.95, 0.889, 0.01, 100000).verdict, ClaimVerdict::unresolved);
    EXPECT_EQ(evaluatedAt(0.95, 0.887, 0.01, 100000).verdict, ClaimVerdict::depends);
    EXPECT_EQ(evaluatedAt(0.95, 0.887, 0.01, 3).verdict, ClaimVerdict::unresolved);
    EXPECT_EQ(evaluateFinding(claim.rule, {found("kept_car", 1, 0, 5)}).note,
              "experiments.csv has no kept_bunny of the experiment 'sampling'");
}

}  // namespace
}  // namespace dustbench::claims
