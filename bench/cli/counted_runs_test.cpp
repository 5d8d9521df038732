// Which runs count, end to end: invalid runs are reported and left out, and copies do not count.
#include <fmt/format.h>
#include <gmock/gmock.h>

#include <fstream>

#include "bench/cli/called_program.h"
#include "methods/kit/files/csv.h"

namespace dustbench::cli {
namespace {

using testing::HasSubstr;
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
    EXPECT_THAT(
        suite.out,
        testing::AllOf(HasSubstr("(2 of 2 invalid)"), HasSubstr("8 invalid runs left out"),
                       HasSubstr("invalid: 8 of 8 runs are invalid and left out of claims, fits and verdicts: "),
                       HasSubstr(": UNRESOLVED: 2 pairs with an invalid run were left out (" + reason)));
    const Called text = call(fmt::format("report {} --text", out()));
    EXPECT_THAT(text.out,
                testing::AllOf(HasSubstr("(2 of 2 invalid)"), HasSubstr("invalid: 8 of 16 runs are invalid")));
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
