// Files and records of a run.
#include "bench/run/measured_run.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <set>

#include "bench/results/summary.h"
#include "bench/run/method_host.h"
#include "methods/contract/registry.h"
#include "methods/kit/testing/test_folder.h"

namespace dustbench::bench {
namespace {
namespace fs = std::filesystem;

RunRecord measured(const fs::path& folder, bool timed) {
    RunSpec spec;
    spec.method = "null_method";
    spec.drive = "straight";
    spec.size = {64, 48};
    spec.frames = 2;
    spec.warmup = 0;
    spec.timed = timed;
    spec.imagesEvery = 1;
    spec.parameters = canonicalParameters(findMethod(spec.method), {{"particles", "20"}, {"preroll", "0.1"}});
    return measureRun(spec, folder, {}, [](std::string_view, std::int64_t, std::int64_t) {});
}

std::set<std::string> columnsOf(const RunRecord& record) {
    std::set<std::string> names;
    for (const auto& [name, value] : record.summary)
        if (!std::holds_alternative<std::monostate>(value)) names.insert(name);
    return names;
}

TEST(MeasuredRun, WithoutTimesKeepsNothingThatDependsOnTheMachinesSpeed) {
    const TestFolder folder;
    const fs::path with = folder.path() / "with", without = folder.path() / "without";
    fs::create_directories(with);
    fs::create_directories(without);
    const RunRecord timed = measured(with, true), untimed = measured(without, false);
    EXPECT_EQ(timed.stateHash, untimed.stateHash);
    EXPECT_NE(runId(timed.spec), runId(untimed.spec));
    const std::set<std::string> all = columnsOf(timed), kept = columnsOf(untimed);
    for (const std::string& name : all) EXPECT_EQ(kept.contains(name), !dependsOnSpeed(name)) << name;
    for (const char* time :
         {"fps_avg", "frame_ms_median", "scene_ms_median", "harness_us_median", "start_s", "run_s"}) {
        EXPECT_TRUE(all.contains(time)) << time;
        EXPECT_TRUE(dependsOnSpeed(time)) << time;
    }
    for (const char* count : {"cpu_bytes", "gpu_bytes", "particles_median", "frames"})
        EXPECT_TRUE(kept.contains(count)) << count;
    for (const char* file : {"frames.csv", "stages.csv"}) {
        EXPECT_TRUE(fs::exists(with / file)) << file;
        EXPECT_FALSE(fs::exists(without / file)) << file;
    }
    EXPECT_TRUE(fs::exists(without / "images/f000001.png"));
    for (const std::string& warning : untimed.provenance.warnings)
        EXPECT_THAT(warning, testing::Not(testing::AnyOf(testing::HasSubstr("busy"), testing::HasSubstr("stall"))));
}

TEST(MeasuredRun, LitDustIsShownByMethodsThatTakeItAlone) {
    scene::Scene scene;
    MethodInfo takes, refuses;
    takes.takesLights = true;
    EXPECT_EQ(whyNotTaken(takes, scene), "");
    EXPECT_EQ(whyNotTaken(refuses, scene), "");
    scene.lights.onDust = true;
    EXPECT_EQ(whyNotTaken(takes, scene), "");
    EXPECT_EQ(whyNotTaken(refuses, scene), "does not support lit dust (light=sun)");
    takes.cannotTake = [](const scene::Scene&) { return "needs a vehicle"; };
    EXPECT_EQ(whyNotTaken(takes, scene), "needs a vehicle");
}

TEST(MeasuredRun, WhetherItHasTimesIsKeptOnTheWayToItsProcess) {
    RunSpec spec;
    spec.method = "null_method";
    spec.timed = false;
    EXPECT_FALSE(specFromJson(specToJson(spec)).timed);
    spec.timed = true;
    EXPECT_TRUE(specFromJson(specToJson(spec)).timed);
}

}  // namespace
}  // namespace dustbench::bench
