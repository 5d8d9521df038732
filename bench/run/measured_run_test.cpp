// Files and records of a run.
#include "bench/run/measured_run.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <set>
#include <string>

#include "bench/results/stored_run.h"
#include "bench/results/summary.h"
#include "bench/run/method_host.h"
#include "methods/contract/registry.h"
#include "methods/kit/testing/test_folder.h"

namespace dustbench::run {
namespace {
namespace fs = std::filesystem;

results::RunRecord measured(const fs::path& folder, bool timed) {
    results::RunSpec spec;
    spec.method = "null_method";
    spec.drive = "straight";
    spec.size = {64, 48};
    spec.frames = 2;
    spec.warmup = 0;
    spec.timed = timed;
    spec.imagesEvery = 1;
    spec.parameters = results::canonicalParameters(findMethod(spec.method), {{"particles", "20"}, {"preroll", "0.1"}});
    return measureRun(spec, folder, {}, [](std::string_view, std::int64_t, std::int64_t) {});
}

std::set<std::string> columnsOf(const results::RunRecord& record) {
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
    const results::RunRecord timed = measured(with, true), untimed = measured(without, false);
    EXPECT_EQ(timed.stateHash, untimed.stateHash);
    EXPECT_NE(results::runId(timed.spec), results::runId(untimed.spec));
    const std::set<std::string> all = columnsOf(timed), kept = columnsOf(untimed);
    for (const std::string& name : all) EXPECT_EQ(kept.contains(name), !results::dependsOnSpeed(name)) << name;
    for (const char* time :
         {"fps_avg", "frame_ms_median", "scene_ms_median", "harness_us_median", "start_s", "run_s"}) {
        EXPECT_TRUE(all.contains(time)) << time;
        EXPECT_TRUE(results::dependsOnSpeed(time)) << time;
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
    results::RunSpec spec;
    spec.method = "null_method";
    spec.timed = false;
    EXPECT_FALSE(results::specFromJson(results::specToJson(spec)).timed);
    spec.timed = true;
    EXPECT_TRUE(results::specFromJson(results::specToJson(spec)).timed);
}

TEST(ThreadLimit, ReplacesThatOfTheEnvironmentForTheRasteriser) {
    const auto limitWith = [](int threads) {
        setenv("LP_NUM_THREADS", "7", 1);
        std::string limit;
        withThreads(threads, [&] { limit = std::getenv("LP_NUM_THREADS"); });
        unsetenv("LP_NUM_THREADS");
        return limit;
    };
    EXPECT_EQ(limitWith(1), "1");
    EXPECT_EQ(limitWith(2), "2");
    EXPECT_EQ(limitWith(0), "7");  // no limit requested
}

// Runs that did not show what was requested are marked as invalid.

using testing::HasSubstr;
using testing::IsEmpty;

class InvalidRun : public testing::Test {
 protected:
    static results::RunRecord measured(const std::string& method, const results::ParameterTexts& parameters) {
        const TestFolder folder;
        results::RunSpec spec;
        spec.method = method;
        spec.drive = "straight";
        spec.size = {64, 48};
        spec.frames = 2;
        spec.warmup = 0;
        spec.parameters = results::canonicalParameters(findMethod(method), parameters);
        return measureRun(spec, folder.path(), {}, [](std::string_view, std::int64_t, std::int64_t) {});
    }
    static results::Value cellOf(const results::RunRecord& record, std::string_view name) {
        for (const auto& [column, value] : record.summary)
            if (column == name) return value;
        return {};
    }
    [[nodiscard]] static bool hasMethod(std::string_view id) {
        return std::ranges::any_of(methods(), [id](const MethodInfo& info) { return info.id == id; });
    }
};

TEST_F(InvalidRun, IsAnOctreeWhoseWorldCannotHoldTheTrail) {
    for (const char* method : {"octree_search", "octree_recursive"}) {
        if (!hasMethod(method)) GTEST_SKIP() << "no octree here";
        // At 40 m/s the trail is longer than 128 m.
        results::ParameterTexts fast{{"particles", "300"}, {"speed", "40"}, {"policy", "accumulate"}};
        const results::RunRecord whole = measured(method, fast);
        EXPECT_THAT(whole.validity, IsEmpty());
        EXPECT_EQ(cellOf(whole, "invalid"), results::Value());
        EXPECT_EQ(cellOf(whole, "clipped"), results::Value(std::int64_t{0}));
        EXPECT_EQ(cellOf(whole, "world_edge_max"), results::Value(256.0));
        fast["depth"] = "12";  // the maximum depth
        const results::RunRecord cut = measured(method, fast);
        ASSERT_THAT(cut.validity, testing::SizeIs(2));
        EXPECT_THAT(cut.validity[0], HasSubstr("clipped is "));
        EXPECT_THAT(cut.validity[1], HasSubstr("mass_lost is "));
        EXPECT_EQ(cellOf(cut, "invalid"), results::Value(cut.validity[0] + "; " + cut.validity[1]));
        EXPECT_THAT(results::toJson(cut), HasSubstr("\"validity\": [\n    \"clipped is "));
    }
}

TEST_F(InvalidRun, HasFewerParticlesThanWereAskedFor) {
    if (!hasMethod("billboard")) GTEST_SKIP() << "no billboards here";
    EXPECT_THAT(measured("billboard", {{"particles", "500"}, {"preroll", "1"}}).validity,
                testing::ElementsAre(HasSubstr("requested: 500")));
    EXPECT_THAT(measured("billboard", {{"particles", "500"}}).validity, IsEmpty());
    if (hasMethod("null_method")) {
        EXPECT_THAT(measured("null_method", {{"particles", "500"}, {"preroll", "1"}}).validity, IsEmpty());
    }
}

TEST_F(InvalidRun, HasFewerParticlesOfItsOwnThanWereAskedFor) {
    if (!hasMethod("plugin_particles")) GTEST_SKIP() << "no particle systems here";
    results::ParameterTexts few{{"particles", "500"}, {"preroll", "1"}};
    EXPECT_THAT(measured("plugin_particles", few).validity, testing::ElementsAre(HasSubstr("alive_deviation is ")));
    few["preroll"] = "6";
    EXPECT_THAT(measured("plugin_particles", few).validity, IsEmpty());
}

TEST_F(InvalidRun, HasAPressureThatRanOutOfCycles) {
    if (!hasMethod("grid_fluid")) GTEST_SKIP() << "no fluid here";
    results::ParameterTexts fluid{{"fluid", "plume"}, {"grid", "16x8x8"}, {"preroll", "0.1"}};
    const results::RunRecord solved = measured("grid_fluid", fluid);
    EXPECT_THAT(solved.validity, IsEmpty());
    EXPECT_EQ(cellOf(solved, "pressure_unsolved"), results::Value(std::int64_t{0}));
    fluid["tolerance"] = "1e-7";  // below the precision of floats
    EXPECT_THAT(measured("grid_fluid", fluid).validity, testing::ElementsAre(HasSubstr("pressure_unsolved is ")));
    fluid["pressure"] = "jacobi";
    const results::RunRecord swept = measured("grid_fluid", fluid);
    EXPECT_THAT(swept.validity, IsEmpty());
    EXPECT_EQ(cellOf(swept, "pressure_unsolved"), results::Value());
}

}  // namespace
}  // namespace dustbench::run
