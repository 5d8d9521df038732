// End-to-end tests of the commands that method folders provide.
#include <gmock/gmock.h>

#include <vtkCellData.h>
#include <vtkDataArray.h>
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkXMLImageDataReader.h>

#include <algorithm>

#include "bench/cli/called_program.h"

namespace dustbench::cli {
namespace {

using testing::HasSubstr;

class ToolCommands : public Dustbench {};

TEST_F(ToolCommands, AreListedAndExplainThemselves) {
    const std::string commands = call("--help").out;
    for (const ToolInfo& tool : tools()) {
        EXPECT_THAT(commands, HasSubstr(tool.summary));
        const Called called = call(tool.id + " --help");
        EXPECT_EQ(called.code, 0);
        for (const ToolOption& option : tool.options) EXPECT_THAT(called.out, HasSubstr(option.name)) << tool.id;
        EXPECT_THAT(called.out, HasSubstr("--data")) << "an option of every command";
    }
}

TEST_F(ToolCommands, ShapeIsEditedInTheOrderGivenAndRuns) {
    if (std::ranges::find(tools(), "shape", &ToolInfo::id) == tools().end()) GTEST_SKIP() << "no such tool";
    std::ofstream(folder_ / "block.toml") << "description = \"\"\n[grid]\ncells = [6, 6, 6]\nedge_metres = 0.25\n";
    const std::string block = "'" + (folder_ / "block.toml").string() + "'";
    const auto edited = [&](const std::string& edits, const std::string& out) {
        const Called called = call(fmt::format("shape {} {} --save '{}'", block, edits, (folder_ / out).string()));
        EXPECT_EQ(called.code, 0) << called.err;
        return contentOf(folder_ / out);
    };
    const std::string red = "--paint 'sphere=0,0.7,0,0.4 colour=1,0,0'",
                      blue = "--paint 'sphere=0,0.7,0,0.4 colour=0,0,1'";
    const std::string carve = "--carve 'box=-1,0,-1,1,0.3,1'";
    const std::string first = edited(red + " " + carve + " " + blue, "a.toml"),
                      second = edited(blue + " " + carve + " " + red, "b.toml");
    EXPECT_LT(first.find("[1, 0, 0]"), first.find("active = false"));
    EXPECT_LT(first.find("active = false"), first.find("[0, 0, 1]"));
    EXPECT_GT(second.find("[1, 0, 0]"), second.find("[0, 0, 1]"));
    const Called run =
        call(fmt::format("run --method voxel_shape -P shape='{}' --frames 1 --warmup 0 -P preroll=0 "
                         "--size 64x48 --out '{}'",
                         (folder_ / "a.toml").string(), out()));
    EXPECT_EQ(run.code, 0) << run.err;
}

TEST_F(ToolCommands, ShapeIsSavedAfterItHasMovedWithTheParticlesItHolds) {
    if (std::ranges::find(tools(), "shape", &ToolInfo::id) == tools().end()) GTEST_SKIP() << "no such tool";
    std::ofstream(folder_ / "block.toml") << "description = \"\"\nparticles = 432\n[grid]\ncells = [6, 6, 6]\n"
                                             "edge_metres = 0.25\n[motion]\nfill_seconds = 0.5\n";
    const std::string block = "shape '" + (folder_ / "block.toml").string() + "' --save '";
    const auto held = [&](const std::string& name) {
        vtkNew<vtkXMLImageDataReader> reader;
        reader->SetFileName((folder_ / name).c_str());
        reader->Update();
        vtkDataArray* const density = reader->GetOutput()->GetCellData()->GetArray("density");
        vtkDataArray* const most = reader->GetOutput()->GetCellData()->GetArray("maximum_density");
        double sum = 0;
        for (vtkIdType i = 0; i < density->GetNumberOfTuples(); ++i) {
            EXPECT_LE(density->GetTuple1(i), most->GetTuple1(i));
            sum += density->GetTuple1(i);
        }
        return sum;
    };
    const Called series = call(block + (folder_ / "a.vti").string() + "' --seconds 1 --every 0.25");
    ASSERT_EQ(series.code, 0) << series.err;
    const std::string index = contentOf(folder_ / "a.pvd");
    double before = 0;
    for (const char* name : {"a_000015.vti", "a_000030.vti", "a_000045.vti", "a_000060.vti"}) {
        EXPECT_THAT(index, HasSubstr(name));
        EXPECT_GE(held(name), before) << "it fills";
        before = held(name);
    }
    EXPECT_GT(before, 350);
    EXPECT_LE(before, 432);
    EXPECT_LT(held("a_000015.vti"), before);
    EXPECT_FALSE(std::filesystem::exists(folder_ / "a.vti"));
    const Called last = call(block + (folder_ / "b.vti").string() + "' --seconds 1");
    EXPECT_THAT(last.out, HasSubstr(fmt::format("{:.0f}", before)));
    EXPECT_EQ(contentOf(folder_ / "b.vti"), contentOf(folder_ / "a_000060.vti"));
    EXPECT_EQ(call(block + (folder_ / "c.vti").string() + "'").code, 0);
    EXPECT_EQ(held("c.vti"), 0) << "it has not moved";
}

TEST_F(ToolCommands, SolversAreComparedWithOnesThatLeftTheirFlows) {
    if (std::ranges::find(tools(), "precision", &ToolInfo::id) == tools().end()) GTEST_SKIP() << "no such tool";
    const std::string folder = "'" + (folder_ / "flows").string() + "'";
    const std::string grids = " --problem ring,car --cells 8 --scheme revert,semi_lagrangian --reference 16";
    const Called first = call("precision " + folder + grids);
    EXPECT_EQ(first.code, 0) << first.err;
    EXPECT_THAT(first.out, HasSubstr("semi_lagrangian"));
    for (const char* file : {"ring_8/begin.flow", "car_8/solids.f32", "car_16/dustbench-revert.flow", "times.csv"})
        EXPECT_TRUE(std::filesystem::exists(folder_ / "flows" / file)) << file;
    const std::string points = contentOf(folder_ / "flows" / "points.csv");
    EXPECT_EQ(std::ranges::count(points, '\n'), 5) << points;
    std::filesystem::copy(folder_ / "flows/ring_8/dustbench-revert.flow", folder_ / "flows/ring_8/other-any.flow");
    const Called again = call("precision " + folder + " --problem nothing --reference 16");
    EXPECT_EQ(again.code, 0) << again.err;
    EXPECT_THAT(contentOf(folder_ / "flows" / "points.csv"), HasSubstr("ring,8,other,any,"));
    for (const char* mistake : {"precision", "precision x --cells 12", "precision x --problem rings",
                                "precision x --scheme mac", "precision x --repetitions 0"}) {
        const Called called = call(mistake);
        EXPECT_EQ(called.code, 3) << mistake;
        EXPECT_EQ(std::ranges::count(called.err, '\n'), 1) << called.err;
    }
}

TEST_F(ToolCommands, TheCarHasTheSameCellsWhateverGridsCameBefore) {
    if (std::ranges::find(tools(), "precision", &ToolInfo::id) == tools().end()) GTEST_SKIP() << "no such tool";
    const auto cellsAfter = [&](const std::string& name, const std::string& grids) {
        const Called called = call("precision '" + (folder_ / name).string() + "' --problem car --scheme nothing " +
                                   "--reference 0 --cells " + grids);
        EXPECT_EQ(called.code, 0) << called.err;
        return contentOf(folder_ / name / "car_64/solids.f32");
    };
    EXPECT_TRUE(cellsAfter("alone", "64") == cellsAfter("after", "8,16,64"));
}

TEST_F(ToolCommands, WrongUseIsOneLineAndExitCodeThree) {
    if (std::ranges::find(tools(), "shape", &ToolInfo::id) == tools().end()) GTEST_SKIP() << "no such tool";
    const std::vector<std::pair<std::string, std::string>> mistakes{
        {"shape", "file"},
        {"shape bal", "'ball'"},
        {"shape ball --pant x", "'--paint'"},
        {"shape ball --save a.toml --save b.toml", "once"},
        {"shape ball --save a.toml --seconds 1", "--save FILE.vti"},
        {"shape ball --save a.vti --every 1", "requires --seconds"},
        {"shape ball --save a.vti --seconds 0", "0.0167..600"},
        {"shape ball --paint", "--paint"},
        {"shape ball --paint 'sphere=0,0,0,0.1 color=1,0,0'", "'colour'"}};
    for (const auto& [arguments, expected] : mistakes) {
        const Called called = call(arguments);
        EXPECT_EQ(called.code, 3) << arguments;
        EXPECT_THAT(called.err, HasSubstr(expected)) << arguments;
        EXPECT_EQ(std::ranges::count(called.err, '\n'), 1) << called.err;
        EXPECT_EQ(called.out, "") << arguments;
    }
}

}  // namespace
}  // namespace dustbench::cli
