// Usage in special situations: help, existing, damaged, invalid and copied results, full devices, estimates.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>

#include "bench/cli/called_program.h"
#include "methods/kit/files/csv.h"

namespace dustbench::cli {
namespace {

using testing::AllOf;
using testing::HasSubstr;

class Usage : public Dustbench {
 protected:
    /// A suite of two short runs.
    [[nodiscard]] std::string suite() const {
        std::ofstream(folder_ / "two.toml") << fmt::format(
            "title = \"two\"\nmethods = [\"{}\"]\nsizes = [\"64x48\"]\nframes = 2\nwarmup = 0\n"
            "[parameters]\npreroll = [0.1, 0.2]\n",
            methods().front().id);
        return "suite " + (folder_ / "two.toml").string();
    }
    /// Calls the program with its output on a device that is always full.
    [[nodiscard]] int callOntoFullDevice(const std::string& arguments) const {
        const int status = std::system(
            fmt::format("'{}' {} >/dev/full 2>'{}'", DUSTBENCH_PROGRAM, arguments, (folder_ / "stderr").string())
                .c_str());
        return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
    }
};

TEST_F(Usage, HelpIsACommandToo) {
    EXPECT_EQ(call("help").out, call("--help").out);
    EXPECT_EQ(call("help run").out, call("run --help").out);
    EXPECT_THAT(call("help run").out, HasSubstr("--frames"));
    const Called unknown = call("help rnu");
    EXPECT_EQ(unknown.code, 3);
    EXPECT_THAT(unknown.err, HasSubstr("did you mean 'run'?"));
    EXPECT_EQ(call("help run suite").code, 3);
}

TEST_F(Usage, AnUnknownKeyIsAnsweredWithTheNearestAndAllOthers) {
    std::ofstream(folder_ / "bad.toml") << "methdos = [\"all\"]\n";
    const Called called = call("suite " + (folder_ / "bad.toml").string() + " --out " + out());
    EXPECT_EQ(called.code, 3);
    for (const char* key : {"(did you mean 'methods'?)", "baseline", "parameters", "quick", "sync", "volumes"})
        EXPECT_THAT(called.err, HasSubstr(key));
}

TEST_F(Usage, AnOptionGivenTwiceIsSaidSo) {
    const Called called = call("run --method null_method --size 64x48 --size 32x24 --out " + out());
    EXPECT_EQ(called.code, 3);
    EXPECT_EQ(called.err, "dustbench: --size: given more than once\n");
}

TEST_F(Usage, WhatCannotBePrintedIsAnError) {
    for (const char* command : {"list methods", "help", "list --json"}) {
        EXPECT_EQ(callOntoFullDevice(command), 2) << command;
        EXPECT_THAT(contentOf(folder_ / "stderr"), HasSubstr("aborted: standard output cannot be written")) << command;
    }
}

TEST_F(Usage, ARunThatIsThereIsKeptUnlessForced) {
    const std::string command = "--frames 2 --out " + out();
    ASSERT_EQ(shortRun(command).code, 0);
    const fs::path record = runs(out()).at(0) / "run.json";
    const std::string first = contentOf(record);
    const Called again = shortRun(command);
    EXPECT_EQ(again.code, 0);
    EXPECT_THAT(again.err, HasSubstr("--force measures it again"));
    EXPECT_THAT(again.out, HasSubstr("frame"));  // its table is printed anyway
    EXPECT_EQ(contentOf(record), first);
    EXPECT_EQ(shortRun(command + " --force").code, 0);
    EXPECT_NE(contentOf(record), first);
}

TEST_F(Usage, WhatTheMachineDoesNotGiveAbortsAndTheSameCommandGoesOn) {
    const std::string command = fmt::format(
        "'{}' run --method {} --size 320x240 --frames 2 --warmup 0 --images 1 -P preroll=0.1 -P particles=50 --out {}",
        DUSTBENCH_PROGRAM, methods().front().id, out());
    // Pictures are larger than 20 kB.
    const int status =
        std::system(fmt::format("ulimit -f 20; {} 2>'{}'", command, (folder_ / "stderr").string()).c_str());
    EXPECT_TRUE(WIFEXITED(status) && WEXITSTATUS(status) == 2) << contentOf(folder_ / "stderr");
    EXPECT_THAT(contentOf(folder_ / "stderr"), AllOf(HasSubstr("dustbench: aborted: "), HasSubstr("File too large")));
    EXPECT_FALSE(fs::exists(out()));
    EXPECT_EQ(std::system((command + " 2>/dev/null").c_str()), 0);
    EXPECT_EQ(runs(out()).size(), 1u);
}

TEST_F(Usage, AFolderWithoutANameIsRefused) {
    const Called called = call("run --method " + methods().front().id + " --frames 1 --out ''");
    EXPECT_EQ(called.code, 3);
    EXPECT_THAT(called.err, HasSubstr("got an empty name"));
}

TEST_F(Usage, AReportOfNothingIsNotWritten) {
    const Called called = call("report " + folder_.string());
    EXPECT_EQ(called.code, 3);
    EXPECT_FALSE(fs::exists(folder_ / "index.html"));
}

TEST_F(Usage, FoldersAreComparedByTheirNamesAlone) {
    ASSERT_EQ(call(suite() + " --out " + out()).code, 0);
    ASSERT_EQ(call(suite() + " --out " + (folder_ / "later").string()).code, 0);
    const fs::path before = fs::current_path();
    fs::current_path(folder_);
    const Called called = call("compare out later");
    fs::current_path(before);
    EXPECT_EQ(called.code, 0) << called.err;
    EXPECT_THAT(called.out, HasSubstr("B = later against A = out"));
}

TEST_F(Usage, ADryRunListsWhatARunWouldMend) {
    ASSERT_EQ(call(suite() + " --out " + out()).code, 0);
    const std::string record = runs(out()).at(0) / "run.json";
    std::ofstream(record) << "{";
    const Called called = call(suite() + " --dry-run --out " + out());
    EXPECT_EQ(called.code, 0) << called.err;
    EXPECT_THAT(called.out, AllOf(HasSubstr("  damaged  "), HasSubstr("  done  ")));
    EXPECT_THAT(called.err, AllOf(HasSubstr("2 runs, 1 to do"), HasSubstr("--estimate")));
    EXPECT_EQ(contentOf(record), "{");
}

TEST_F(Usage, AnEstimateLeavesNothing) {
    const Called called = call(suite() + " --estimate --out " + out());
    EXPECT_EQ(called.code, 0) << called.err;
    EXPECT_EQ(std::ranges::count(called.out, '\n'), 2);
    EXPECT_THAT(called.err, testing::ContainsRegex("estimate: [0-9]+ s for 2 runs"));
    EXPECT_FALSE(fs::exists(out()));
}

TEST_F(Usage, OneSuiteIsListedWhole) {
    const Called called = call("list suites harness-same");
    EXPECT_EQ(called.code, 0);
    for (const char* part : {"harness-same.toml", "full ", "--quick ", "repetitions", "null_method"})
        EXPECT_THAT(called.out, HasSubstr(part));
}

TEST_F(Usage, TooLargeAPictureIsOneLine) {
    const Called called =
        call("run --method " + methods().front().id + " --size 16384x16384 --frames 1 --out " + out());
    if (called.code == 0) GTEST_SKIP() << "this machine can draw it";
    EXPECT_EQ(called.code, 3);
    EXPECT_THAT(called.err, HasSubstr("cannot be allocated"));
}

// --- Which runs count: invalid runs are reported and left out, and copies do not count

using CountedRuns = Dustbench;

TEST_F(CountedRuns, RunsThatAreInvalidAreSaidWhereverTheirNumbersStand) {
    // After a tenth of a second there are far fewer particles than requested.
    std::ofstream(folder_ / "early.toml") << fmt::format(
        "title = \"Early\"\nmethods = [\"{0}\"]\nsizes = [\"16x12\"]\nframes = 2\nwarmup = 0\nrepetitions = 2\n"
        "[parameters]\npreroll = 0.1\nparticles = [100, 200, 400, 800]\n[[fit]]\nagainst = \"particles\"\ncolumns = "
        "[\"draw_ms_median\"]\n[[compare]]\nof = \"{0} particles=100\"\nwith = \"{0} particles=200\"\n"
        "columns = [\"frame_ms_median\"]\n",
        methods().front().id);
    const std::string reason = "particles_median is ";
    const Called suite = call(fmt::format("suite {}/early.toml --out {}", folder_.string(), out()));
    ASSERT_EQ(suite.code, 0) << suite.err;
    EXPECT_THAT(suite.out,
                AllOf(HasSubstr("(2 of 2 invalid)"), HasSubstr("8 invalid runs left out"),
                      HasSubstr("invalid: 8 of 8 runs are invalid and left out of claims, fits and verdicts: "),
                      HasSubstr(": UNRESOLVED: 2 pairs with an invalid run were left out (" + reason)));
    const Called text = call(fmt::format("report {} --text", out()));
    EXPECT_THAT(text.out, AllOf(HasSubstr("(2 of 2 invalid)"), HasSubstr("invalid: 8 of 16 runs are invalid")));
    const Called run = call(
        fmt::format("run --method {} --size 16x12 --warmup 0 --frames 2 -P preroll=0.1 -P particles=500 --out {}/one",
                    methods().front().id, folder_.string()));
    EXPECT_THAT(run.out, HasSubstr("\n  invalid: " + reason));
}

TEST_F(CountedRuns, ARunThatIsCopiedUnderAnotherNameCountsOnce) {
    ASSERT_EQ(shortRun("--frames 3 --out " + out()).code, 0);
    const fs::path run = runs(out()).front();
    const fs::path copy = run.string() + "-copy";
    fs::copy(run, copy, fs::copy_options::recursive);
    const std::string reason =
        fmt::format("contains the run '{}', expected the run that the folder is named after", run.filename().string());
    const Called text = call(fmt::format("report {} --text", out()));
    EXPECT_EQ(text.code, 0);
    EXPECT_THAT(text.err, HasSubstr("left out: '" + copy.string()));
    EXPECT_THAT(text.err, HasSubstr(reason));
    for (const std::string& command : {fmt::format("recommend --from {} --budget 4ms", out()),
                                       fmt::format("merge {} --out {}/merged", out(), folder_.string()),
                                       fmt::format("compare {}/ {}/merged/", out(), folder_.string())}) {
        const Called called = call(command);
        EXPECT_EQ(called.code, 3) << command;
        EXPECT_THAT(called.err, HasSubstr(reason)) << command;
    }
    // A command that writes into the folder sets the copy aside.
    const Called again = shortRun("--frames 3 --out " + out());
    EXPECT_EQ(again.code, 0);
    EXPECT_THAT(again.err, HasSubstr("set aside as "));
    EXPECT_EQ(files::CsvTable::parseFile(fs::path(out()) / "summary.csv").rows(), 1u);
    EXPECT_FALSE(fs::exists(copy));
}

}  // namespace
}  // namespace dustbench::cli
