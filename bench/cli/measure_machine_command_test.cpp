// `dustbench measure-machine`: measures, leaves out with a reason, resumes, and packs a bundle that can be checked.
#include <gmock/gmock.h>

#include <algorithm>
#include <map>

#include "bench/cli/called_program.h"
#include "methods/kit/files/csv.h"

namespace dustbench::cli {
namespace {

using testing::HasSubstr;
using testing::Not;

class MeasureMachine : public Dustbench {
 protected:
    [[nodiscard]] std::string at(const std::string& name) const { return (folder_ / name).string(); }
    /// The self-check draws one small picture: one that is right, or one that lacks its reference.
    [[nodiscard]] std::string dataWith(bool passes) const {
        fs::create_directories(folder_ / "data" / "scenes");
        fs::create_directories(folder_ / "data" / "selfcheck");
        std::ofstream(folder_ / "data" / "selfcheck" / "pictures.toml")
            << "size = \"96x72\"\n[[picture]]\nname = \"dust\"\nmethod = \"exact_tiles\"\nflip = 0.01\nreference = \""
            << (passes ? "exact" : "kept") << "\"\nparameters = { particles = 50 }\n";
        return " --data " + at("data");
    }
    /// A plan of one suite, which takes the place of the delivered one.
    void usePlan(const std::string& limits) const {
        fs::create_directories(folder_ / "data" / "machines");
        fs::create_directories(folder_ / "data" / "suites");
        std::string plan = "memory_share = 0.5\n[[suite]]\nid = \"tiny\"\nload = \"particles\"\n";
        for (const char* table : {"hardware", "software", "quick"})
            plan += "[" + std::string(table) + "]\n" + limits + "\n";
        std::ofstream(folder_ / "data" / "machines" / "measure-machine.toml") << plan;
        std::ofstream(folder_ / "data" / "suites" / "tiny.toml")
            << "methods = [\"billboard\"]\nsizes = [\"48x36\", \"64x48\"]\nframes = 5\nwarmup = 1\n"
               "[parameters]\nparticles = [50, 100]\npreroll = 0.1\n";
    }
    [[nodiscard]] files::CsvTable summary() const {
        return files::CsvTable::parseFile(folder_ / "out" / "summary.csv");
    }
};

TEST_F(MeasureMachine, MeasuresErrorAndTimeAndPacksABundleThatVerifies) {
    const std::string data = dataWith(true);
    const Called called = call("measure-machine --quick --out " + out() + data);
    ASSERT_EQ(called.code, 0) << called.err;
    EXPECT_THAT(called.out, HasSubstr("out.tar"));
    const files::CsvTable table = summary();
    bool hasBoth = false;
    for (std::size_t row = 0; row < table.rows(); ++row) {
        EXPECT_EQ(table.cell(row, "status"), "done") << table.cell(row, "reason");
        EXPECT_GT(table.number(row, "run_s"), 0);
        hasBoth = hasBoth || (!table.cell(row, "flip_mask").empty() && !table.cell(row, "method_ms_median").empty());
    }
    EXPECT_TRUE(hasBoth) << "error and time stand in one row";
    for (const char* file : {"index.html", "selfcheck.json", "tables/summary.csv", "tables/machine.csv"})
        EXPECT_TRUE(fs::exists(folder_ / "out" / file)) << file;
    EXPECT_THAT(contentOf(folder_ / "out" / "index.html"), HasSubstr("flip_mask"));

    const Called verified = call("verify " + at("out.tar") + " --runs 2" + data);
    EXPECT_EQ(verified.code, 0) << verified.err << verified.out;
    std::string bundle = contentOf(folder_ / "out.tar");
    EXPECT_THAT(bundle, HasSubstr("suites/machine-dust.toml"));
    EXPECT_THAT(bundle, HasSubstr("suites/measure-machine.toml"));
    const std::size_t byte = bundle.find("frame_ms,");
    ASSERT_NE(byte, std::string::npos);
    bundle[byte] = 'F';
    std::ofstream(folder_ / "altered.tar", std::ios::binary) << bundle;
    const Called altered = call("verify " + at("altered.tar") + " --runs 0" + data);
    EXPECT_EQ(altered.code, 3) << altered.out;
    EXPECT_THAT(altered.err, HasSubstr("was altered"));

    const Called again = call("measure-machine --quick --out " + out() + data);
    EXPECT_EQ(again.code, 0) << again.err;
    EXPECT_THAT(again.err, Not(HasSubstr("self-check"))) << "everything is there already";
    fs::copy(folder_ / "out" / "tables", folder_ / "other");
    std::string machine = contentOf(folder_ / "other" / "machine.csv");
    machine.replace(machine.rfind(",20"), 3, ",19");  // another century, so that it is not a copy
    std::ofstream(folder_ / "other" / "machine.csv") << machine;
    const Called machines = call("report " + at("out/tables") + " " + at("other") + " --text" + data);
    EXPECT_EQ(machines.code, 0) << machines.err;
}

TEST_F(MeasureMachine, LeavesOutWhatDoesNotFitAndSaysWhy) {
    const std::string data = dataWith(true);
    usePlan("total_limit_s = 0.1\nrun_limit_s = 60\njudging_limit_s = 60");
    const Called called = call("measure-machine --out " + out() + data);
    EXPECT_EQ(called.code, 1) << called.err << "the self-check took all the time";
    const files::CsvTable table = summary();
    EXPECT_EQ(table.rows(), 4u);
    for (std::size_t row = 0; row < table.rows(); ++row) {
        EXPECT_EQ(table.cell(row, "status"), "skipped");
        EXPECT_THAT(table.cell(row, "reason"),
                    testing::AnyOf(HasSubstr("the limit of 0.1 s for all runs is reached"), HasSubstr("was left out")));
    }
    usePlan("total_limit_s = 100\nrun_limit_s = 60\njudging_limit_s = 60");
    const Called longer = call("measure-machine --out " + out() + data);
    EXPECT_EQ(longer.code, 0) << longer.err;
    EXPECT_THAT(longer.err, HasSubstr("4 runs done"));
}

TEST_F(MeasureMachine, AFailedSelfCheckEndsWithOneAfterTheRestWasMeasuredAndMarked) {
    const std::string data = dataWith(false);
    usePlan("total_limit_s = 100\nrun_limit_s = 60\njudging_limit_s = 60");
    const Called called = call("measure-machine --out " + out() + data);
    EXPECT_EQ(called.code, 1) << called.err;
    EXPECT_THAT(called.err, HasSubstr("4 runs done"));
    EXPECT_THAT(called.err, HasSubstr("dustbench: the self-check failed, the results may be wrong: picture dust"));
    EXPECT_THAT(contentOf(folder_ / "out" / "index.html"), HasSubstr("the self-check failed"));
    EXPECT_EQ(call("verify " + at("out.tar") + " --runs 0" + data).code, 0);
}

TEST_F(MeasureMachine, MeasuresAgainOnceWhereTheClockFellAndThenMarksTheRun) {
    const std::string data = dataWith(true);
    usePlan("total_limit_s = 100\nrun_limit_s = 60\njudging_limit_s = 60");
    const Called called = callAs("env", fmt::format("LD_LIBRARY_PATH='{}' '{}' measure-machine --out {}{}",
                                                    FALLING_CLOCK, DUSTBENCH_PROGRAM, out(), data));
    ASSERT_EQ(called.code, 0) << called.err;
    if (called.err.find("llvmpipe") == std::string::npos) GTEST_SKIP() << "the clock made up is that of llvmpipe";
    for (int run = 1; run <= 4; ++run) {
        const std::string line = fmt::format("run {} of 4: billboard", run);
        const std::size_t first = called.err.find(line), second = called.err.find(line, first + 1);
        EXPECT_NE(second, std::string::npos) << line;
        EXPECT_EQ(called.err.find(line, second + 1), std::string::npos) << line;
    }
    EXPECT_THAT(called.err, HasSubstr("runs whose clock fell, even when they were measured again: 4"));
    const files::CsvTable table = summary();
    for (std::size_t row = 0; row < table.rows(); ++row)
        EXPECT_LT(table.number(row, "gpu_mhz_min"), table.number(row, "gpu_mhz_max"));
    for (const char* file : {"index.html", "tables/runs.csv"})
        EXPECT_THAT(contentOf(folder_ / "out" / file), HasSubstr("clock fell: the GPU's from")) << file;
}

TEST_F(MeasureMachine, ResumesWhereItWasInterrupted) {
    const std::string arguments = "measure-machine --quick --out " + out() + dataWith(true);
    const Called stopped =
        callAs("timeout", fmt::format("--preserve-status -s INT 7 '{}' {}", DUSTBENCH_PROGRAM, arguments));
    ASSERT_EQ(stopped.code, 2) << stopped.err;
    EXPECT_THAT(stopped.err, HasSubstr("aborted; the same command resumes"));
    EXPECT_FALSE(fs::exists(folder_ / "out.tar"));
    std::map<std::string, std::string> before;
    if (fs::exists(folder_ / "out" / "runs"))
        for (const fs::path& run : runs(out())) before[run.filename()] = contentOf(run / "run.json");
    const Called resumed = call(arguments);
    EXPECT_EQ(resumed.code, 0) << resumed.err;
    for (const auto& [run, json] : before) EXPECT_EQ(contentOf(folder_ / "out" / "runs" / run / "run.json"), json);
    EXPECT_TRUE(fs::exists(folder_ / "out.tar"));
}

TEST_F(MeasureMachine, RefusesABundleThatIsNotItsOwn) {
    std::ofstream(folder_ / "out.tar") << "mine";
    const Called called = call("measure-machine --quick --out " + out());
    EXPECT_EQ(called.code, 3);
    EXPECT_THAT(called.err, HasSubstr("out.tar': already exists"));
    EXPECT_EQ(contentOf(folder_ / "out.tar"), "mine");
    EXPECT_FALSE(fs::exists(folder_ / "out"));
}

}  // namespace
}  // namespace dustbench::cli
