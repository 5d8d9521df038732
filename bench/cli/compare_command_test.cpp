// End-to-end tests of `compare`, of methods and of results folders.
#include <fmt/format.h>
#include <gmock/gmock.h>

#include <fstream>
#include <regex>
#include <sstream>

#include "bench/cli/called_program.h"
#include "bench/results/compared_runs.h"
#include "bench/results/run_record.h"
#include "methods/kit/files/csv.h"
#include "methods/kit/pictures/image.h"

namespace dustbench::cli {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

class CompareCommand : public Dustbench {
 protected:
    void SetUp() override {
        Dustbench::SetUp();
        if (std::ranges::none_of(methods(), [](const MethodInfo& info) { return info.id == "billboard"; }))
            GTEST_SKIP() << "no billboards here";
        if (!results::findBaseline()) GTEST_SKIP() << "no null method here";
    }
    [[nodiscard]] Called compare(const std::string& more) const {
        return call(fmt::format("compare --out '{}' {}", out(), more));
    }
};

TEST_F(CompareCommand, WritesMetricsSummaryAndContactSheetAndGoesOnWhereItWas) {
    const std::string both =
        "billboard billboard:soft=true --size 96x72 --frames 6 --warmup 1 --repetitions 2 -P preroll=0.3 "
        "-P particles=200";
    const Called first = compare(both);
    ASSERT_EQ(first.code, 0) << first.err;
    EXPECT_THAT(first.out, AllOf(HasSubstr("psnr_db"), HasSubstr("billboard soft=on"), HasSubstr("UNRESOLVED")));
    const auto summary = files::CsvTable::parseFile(fs::path(out()) / "summary.csv");
    ASSERT_EQ(summary.rows(), 6u);
    for (std::size_t row = 0; row < 6; ++row) {
        const bool isNull = summary.cell(row, "method") == results::baselineMethod;
        EXPECT_EQ(summary.cell(row, "flip").empty(), isNull || summary.cell(row, "repetition") != "1");
        EXPECT_EQ(summary.cell(row, "method_ms_median").empty(), isNull);
    }
    const pictures::Image sheet = pictures::readImage(fs::path(out()) / "contact_sheet.png");
    EXPECT_GT(sheet.width, 5 * 400);
    EXPECT_GT(sheet.height, 5 * 300);

    const Called again = compare(both);
    EXPECT_EQ(again.code, 0);
    EXPECT_THAT(again.err, HasSubstr("6 existing"));
    EXPECT_EQ(again.out, first.out);
}

TEST_F(CompareCommand, LeavesTheSvgAndSaysWhyWhereNothingDrawsIt) {
    const char* const path = std::getenv("PATH");
    const std::string before = path ? path : "";
    setenv("PATH", folder_.c_str(), 1);
    const Called called = compare(
        "billboard billboard:soft=true --size 96x72 --frames 6 --warmup 1 --repetitions 1 -P preroll=0.1 "
        "-P particles=50");
    setenv("PATH", before.c_str(), 1);
    EXPECT_EQ(called.code, 0) << called.err;
    EXPECT_THAT(called.out, AllOf(HasSubstr("contact_sheet.svg"), HasSubstr("no contact_sheet.png: "),
                                  HasSubstr("'rsvg-convert', which is not installed")));
    EXPECT_TRUE(fs::exists(fs::path(out()) / "contact_sheet.svg"));
    EXPECT_FALSE(fs::exists(fs::path(out()) / "contact_sheet.png"));
}

TEST_F(CompareCommand, ShowsAMethodWithASimulationOfItsOwnBesideTheJudged) {
    if (std::ranges::none_of(methods(), [](const MethodInfo& info) { return info.id == "grid_fluid"; }))
        GTEST_SKIP() << "no fluid here";
    const Called called = compare(
        "grid_fluid:grid=16x8x8 billboard --size 96x72 --frames 6 --warmup 1 --repetitions 1 -P preroll=0.1 "
        "-P particles=50");
    ASSERT_EQ(called.code, 0) << called.err;
    const pictures::Image sheet = pictures::readImage(fs::path(out()) / "contact_sheet.png");
    // The reference image, both methods, and the difference of one.
    EXPECT_GT(sheet.width, 4 * 400);
    EXPECT_LT(sheet.width, 5 * 400);
    const auto summary = files::CsvTable::parseFile(fs::path(out()) / "summary.csv");
    ASSERT_EQ(summary.rows(), 3u);
    for (std::size_t row = 0; row < 3; ++row)
        EXPECT_TRUE(fs::exists(fs::path(out()) / summary.cell(row, "FILE_image")));
}

TEST_F(CompareCommand, TurnsTheSheetOfManyMethods) {
    const Called called = compare(
        "billboard billboard:soft=true billboard:mode=paper null_method null_method:work=1 --size 96x72 --frames 5 "
        "--warmup 1 --repetitions 1 -P preroll=0.1 -P particles=50");
    ASSERT_EQ(called.code, 0) << called.err;
    const pictures::Image sheet = pictures::readImage(fs::path(out()) / "contact_sheet.png");
    // Five moments of the reference image and of five methods, with their differences.
    EXPECT_GT(sheet.width, 10 * 400);
    EXPECT_LT(sheet.width, 11 * 400 + 160);
    EXPECT_GT(sheet.height, 6 * 300);
    std::ifstream file(fs::path(out()) / "contact_sheet.svg");
    const std::string svg{std::istreambuf_iterator<char>(file), {}};
    for (const char* heading : {">reference<", ">billboard<", ">null_method<", ">difference<"})
        EXPECT_THAT(svg, HasSubstr(heading));
    EXPECT_THAT(svg, Not(HasSubstr("difference of")));
}

TEST_F(CompareCommand, RefusesInOneLine) {
    const auto refused = [&](const std::string& more) {
        const Called called = compare(more);
        EXPECT_EQ(called.code, 3) << more;
        EXPECT_EQ(std::ranges::count(called.err, '\n'), 1) << called.err;
        EXPECT_FALSE(fs::exists(out())) << more;
        return called.err;
    };
    EXPECT_THAT(refused(""), HasSubstr("methods"));
    EXPECT_THAT(refused("billboard"), HasSubstr("2 or more"));
    EXPECT_THAT(refused("billboard billbord"), HasSubstr("did you mean"));
    EXPECT_THAT(refused("billboard a/b"), HasSubstr("billboard' together with a results folder"));
    EXPECT_THAT(refused("billboard billboard:soft=true --moments 0:4"), HasSubstr("got 4 frames (0:4:1)"));
    EXPECT_THAT(refused("billboard billboard:soft=true --moments 0:200:2"), HasSubstr("beyond the run's end"));
    EXPECT_THAT(refused("billboard billboard:soft=true -P particles=1,2"), HasSubstr("got 2 values"));
    EXPECT_THAT(refused("billboard billboard:soft=true --drive nowhere"), HasSubstr("nowhere"));
}

// --- compare DIR_A DIR_B, on folders with generated run.json files

class CompareFolders : public Dustbench {
 protected:
    /// Six runs of each of two configurations. `change` is applied to each record before it is written.
    template <typename Change>
    void write(const std::string& name, double factor, const Change& change) const {
        for (const int particles : {100, 900})
            for (int repetition = 1; repetition <= 6; ++repetition) {
                results::RunRecord record;
                record.spec.method = "haze";
                record.spec.parameters["particles"] = std::to_string(particles);
                record.spec.repetition = repetition;
                record.stateHash = "0123456789abcdef";
                record.provenance.machine.cpu = "Cpu 1";
                record.provenance.build.buildType = "Release";
                record.outputs.emplace();
                change(record);
                record.summary = {{"repetition", std::int64_t{repetition}},
                                  {"frame_ms_median", particles * factor * (1 + 0.002 * repetition)}};
                if (!record.validity.empty()) record.summary.emplace_back("invalid", record.validity.front());
                const fs::path folder = folder_ / name / "runs" / results::runId(record.spec);
                fs::create_directories(folder);
                std::ofstream(folder / "run.json") << results::toJson(record);
            }
    }
    void write(const std::string& name, double factor) const {
        write(name, factor, [](results::RunRecord&) {});
    }
    [[nodiscard]] Called compare(const std::string& b, const std::string& more = "--fail-on-regression 5") const {
        return call(fmt::format("compare '{0}/a/' '{0}/{1}/' {2}", folder_.string(), b, more));
    }
};

TEST_F(CompareFolders, ExitCodesTellAllIsWellARegressionAndWhatCannotBeCompared) {
    write("a", 1);
    write("same", 1.001);
    write("slower", 1.1);
    write("elsewhere", 1, [](results::RunRecord& record) { record.provenance.machine.cpu = "Cpu 2"; });
    write("other", 1, [](results::RunRecord& record) { record.stateHash = "fedcba9876543210"; });
    write("debug", 1, [](results::RunRecord& record) { record.provenance.build.buildType = "Debug"; });
    write("shorter", 1, [](results::RunRecord& record) { record.spec.frames = 9; });

    const Called same = compare("same");
    EXPECT_EQ(same.code, 0) << same.err;
    EXPECT_THAT(same.out, AllOf(HasSubstr("frame_ms_median, all"), HasSubstr("SAME")));
    EXPECT_EQ(same.err, "");
    const Called slower = compare("slower");
    EXPECT_EQ(slower.code, 5);
    EXPECT_THAT(slower.err, HasSubstr("regression: frame_ms_median: haze particles=900 takes 1.1 ["));
    EXPECT_EQ(compare("slower", "").code, 0);
    EXPECT_EQ(compare("slower", "--fail-on-regression 12").code, 0);
    for (const auto& [folder, word] : {std::pair("elsewhere", "cpu: 'Cpu 1' in A and 'Cpu 2' in B (2 configurations)"),
                                       {"other", "state_hash '0123456789abcdef' in A and 'fedcba9876543210' in B"},
                                       {"debug", "build_type: 'Release' in A and 'Debug' in B"},
                                       {"shorter", "differ in frames"}}) {
        const Called called = compare(folder);
        EXPECT_EQ(called.code, 6) << folder;
        EXPECT_THAT(called.err, HasSubstr(word));
        EXPECT_EQ(called.out, "");
    }
    EXPECT_EQ(compare("elsewhere", "--across-machines").code, 0);
    EXPECT_THAT(compare("debug", "--across-machines").err, HasSubstr("12 of 12 runs were measured by a 'Debug' build"));
    EXPECT_EQ(compare("other", "--across-machines").code, 6);
}

TEST_F(CompareFolders, AnAlertIsMeasuredAgainAndStandsOnlyIfItAlertsAgain) {
    std::ofstream(folder_ / "small.toml")
        << "methods = [\"null_method\"]\nsizes = [\"16x12\"]\nframes = 3\nwarmup = 0\nrepetitions = 6\n"
           "[parameters]\npreroll = 0.1\nparticles = [10, 20]\n";
    ASSERT_EQ(call(fmt::format("suite '{0}/small.toml' --out '{0}/a'", folder_.string())).code, 0);
    fs::copy(folder_ / "a", folder_ / "b", fs::copy_options::recursive);
    /// Replaces the frame times of all runs by this many ms.
    const auto pretend = [this](const std::string& name, double ms) {
        for (const fs::path& run : runs((folder_ / name).string())) {
            std::stringstream text;
            text << std::ifstream(run / "run.json").rdbuf();
            static const std::regex time(R"("frame_ms_median": [^,]*)");
            std::ofstream(run / "run.json") << std::regex_replace(
                text.str(), time, fmt::format("\"frame_ms_median\": {}", ms * (1 + 0.001 * run.string().back())));
        }
    };
    pretend("b", 1e5);
    const Called chance = compare(
        "b", fmt::format("--fail-on-regression 2000 --out '{0}/c' --markdown '{0}/told.txt'", folder_.string()));
    EXPECT_EQ(chance.code, 0) << chance.err;
    EXPECT_THAT(chance.err, AllOf(HasSubstr("not confirmed: frame_ms_median: null_method particles=10 takes "),
                                  HasSubstr("measured again, it takes "), testing::Not(HasSubstr("regression: "))));
    EXPECT_EQ(runs((folder_ / "c" / "again").string()).size(), 12u);
    std::stringstream markdown;
    markdown << std::ifstream(folder_ / "told.txt").rdbuf();
    EXPECT_THAT(markdown.str(), testing::StartsWith("**0 of 3 comparisons are slower.** B is "));

    pretend("a", 1e-4);
    const Called real =
        compare("b", fmt::format("--fail-on-regression 2000 --markdown '{}/told.txt'", folder_.string()));
    EXPECT_EQ(real.code, 5) << real.err;
    EXPECT_THAT(real.err, AllOf(HasSubstr("regression: frame_ms_median: null_method particles=10 takes "),
                                HasSubstr("regression: frame_ms_median: the mean of all configurations takes "),
                                HasSubstr("measured again, it takes "), testing::Not(HasSubstr("not confirmed"))));
    markdown.str("");
    markdown << std::ifstream(folder_ / "told.txt").rdbuf();
    EXPECT_THAT(markdown.str(), AllOf(testing::StartsWith("**3 of 3 comparisons are slower.** B is "),
                                      HasSubstr("\n| column | method | particles |"), HasSubstr("<details>")));
}

TEST_F(CompareFolders, AFolderAgainstItselfPassesNoGate) {
    write("a", 1, [](results::RunRecord& record) { record.provenance.startedUtc = "2026-01-02T03:04:05Z"; });
    fs::create_directory_symlink(folder_ / "a", folder_ / "link");
    fs::create_directories(folder_ / "within");
    fs::create_directory_symlink(folder_ / "a" / "runs", folder_ / "within" / "runs");
    for (const char* same : {"a", "a/../a", "link", "within"}) {
        const Called called = compare(same);
        EXPECT_EQ(called.code, 3) << same;
        EXPECT_THAT(called.err, HasSubstr("are the same folder, expected"));
        EXPECT_EQ(called.out, "");
    }
    fs::copy(folder_ / "a", folder_ / "copy", fs::copy_options::recursive);
    const Called copied = compare("copy");
    EXPECT_EQ(copied.code, 6);
    EXPECT_THAT(copied.err, HasSubstr("not comparable: 12 runs of B are copied from A"));
}

TEST_F(CompareFolders, AnotherQuotaIsANote) {
    write("a", 1);
    write("less", 1.001, [](results::RunRecord& record) { record.provenance.machine.quotaCores = 0.5; });
    const Called called = compare("less");
    EXPECT_EQ(called.code, 0) << called.err;
    EXPECT_THAT(called.err, HasSubstr("note: quota_cores: '0' in A and '0.5' in B (2 configurations)"));
}

TEST_F(CompareFolders, InvalidRunsAreSaidAndPassNoGate) {
    const auto invalid = [](results::RunRecord& record) { record.validity = {"clipped is 4, allowed: up to 0"}; };
    write("a", 1);
    write("all", 1, invalid);
    const Called one = compare("all");
    EXPECT_EQ(one.code, 6) << one.err;
    EXPECT_THAT(one.err, AllOf(HasSubstr("note: B: 12 of 12 runs are invalid"), HasSubstr("clipped is 4")));
    write("some", 1.001, [&](results::RunRecord& record) {
        if (record.spec.parameters["particles"] == "900") invalid(record);
    });
    const Called some = compare("some");
    EXPECT_EQ(some.code, 5) << some.err;
    EXPECT_THAT(some.err, HasSubstr("regression: haze particles=900: in B invalid: clipped is 4"));
}

TEST_F(CompareFolders, WhatAnotherBuildMeasuredCannotBeMeasuredAgainAndStands) {
    write("a", 1);
    write("slower", 1.1);
    const Called slower = compare("slower");
    EXPECT_EQ(slower.code, 5);
    EXPECT_THAT(slower.err, HasSubstr("note: not measured again: measured by another build of dustbench"));
}

TEST_F(CompareFolders, AGateThatCouldNotCloseIsNotPassed) {
    write("a", 1);
    write("few", 3);
    for (const fs::path& run : runs((folder_ / "few").string()))
        if (run.filename().string().find("-r6-") != std::string::npos) fs::remove_all(run);
    EXPECT_EQ(compare("few", "").code, 0);
    const Called called = compare("few");
    EXPECT_EQ(called.code, 6);
    EXPECT_THAT(called.err, HasSubstr("no configuration has 6 timed runs"));
    // A new failure is a regression even with few runs.
    write("fails", 1, [](results::RunRecord& record) {
        if (record.spec.repetition > 1) return;
        record.status = results::RunStatus::timeout;
        record.reason = "not finished after 2 s";
    });
    EXPECT_EQ(compare("fails").code, 5);
    EXPECT_THAT(compare("fails").err, HasSubstr("in B timed out: not finished after 2 s"));
}

TEST_F(CompareFolders, WritesACsvAndTakesFoldersAsTheyAre) {
    write("a", 1);
    write("b", 1.1);
    fs::create_directories(folder_ / "b" / "runs" / ".unfinished-x");
    const Called called = compare("b", fmt::format("--out '{}'", out()));
    ASSERT_EQ(called.code, 0) << called.err;
    const auto table = files::CsvTable::parseFile(fs::path(out()) / "comparison.csv");
    ASSERT_EQ(table.rows(), 3u);
    EXPECT_NEAR(table.number(0, "ratio"), 1.1, 1e-9);
    EXPECT_EQ(table.cell(2, "all_cells"), "1");
    EXPECT_TRUE(fs::exists(folder_ / "b" / "runs" / ".unfinished-x"));
    EXPECT_FALSE(fs::exists(folder_ / "b" / "summary.csv"));
}

TEST_F(CompareFolders, AlteredResultsAreRefusedAndThoseThatCannotTellAreSaid) {
    write("a", 1);
    write("older", 1, [](results::RunRecord& record) { record.outputs.reset(); });
    const Called older = compare("older");
    EXPECT_EQ(older.code, 0);
    EXPECT_THAT(older.err, AllOf(HasSubstr("older/': 12 of 12 runs"), HasSubstr("cannot be detected")));
    EXPECT_EQ(std::ranges::count(older.err, '\n'), 1) << older.err;
    write("cut", 1, [](results::RunRecord& record) { record.outputs = {{"frames.csv", 1, ""}}; });
    const Called cut = compare("cut");
    EXPECT_EQ(cut.code, 3);
    EXPECT_THAT(cut.err, HasSubstr("frames.csv is missing"));
}

TEST_F(CompareFolders, BadInputIsOneLineAndExitCodeThree) {
    write("a", 1);
    write("cut", 1);
    const fs::path cut = runs((folder_ / "cut").string()).front() / "run.json";
    std::ofstream(cut) << "{\"run_id\": ";
    for (const auto& [more, word] :
         {std::pair("cut/", "run.json: is not a run.json"), {"nowhere/", "is not a results folder"}}) {
        const Called called = call(fmt::format("compare '{0}/a/' '{0}/{1}'", folder_.string(), more));
        EXPECT_EQ(called.code, 3);
        EXPECT_THAT(called.err, HasSubstr(word));
        EXPECT_EQ(std::ranges::count(called.err, '\n'), 1) << called.err;
    }
    for (const auto& [more, word] : {std::pair("--frames 5", "--frames: applies only to methods"),
                                     {"--columns frame_ms", "did you mean 'frame_ms_"},
                                     {"--columns fps_avg,fps_avg", "'fps_avg' twice"},
                                     {"--fail-on-regression much", "'much'"},
                                     {"--fail-on-regression -1", "'-1'"}}) {
        const Called called = compare("a", more);
        EXPECT_EQ(called.code, 3) << more;
        EXPECT_THAT(called.err, HasSubstr(word));
    }
    EXPECT_THAT(call("compare ./a billboard").err, HasSubstr("'billboard' together with a results folder"));
    EXPECT_THAT(call("compare ./a ./b ./c").err, HasSubstr("got 3 results folders"));
    EXPECT_THAT(call("compare billboard billboard:soft=true --columns fps_avg").err, HasSubstr("not to methods"));
}

}  // namespace
}  // namespace dustbench::cli
