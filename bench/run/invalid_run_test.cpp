// Runs that did not show what was requested are marked as invalid.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "bench/results/stored_run.h"
#include "bench/run/measured_run.h"
#include "methods/contract/registry.h"
#include "methods/kit/testing/test_folder.h"

namespace dustbench::bench {
namespace {

using testing::HasSubstr;
using testing::IsEmpty;

class InvalidRun : public testing::Test {
 protected:
    static RunRecord measured(const std::string& method, const ParameterTexts& parameters) {
        const TestFolder folder;
        RunSpec spec;
        spec.method = method;
        spec.drive = "straight";
        spec.size = {64, 48};
        spec.frames = 2;
        spec.warmup = 0;
        spec.parameters = canonicalParameters(findMethod(method), parameters);
        return measureRun(spec, folder.path(), {}, [](std::string_view, std::int64_t, std::int64_t) {});
    }
    static Value cellOf(const RunRecord& record, std::string_view name) {
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
        ParameterTexts fast{{"particles", "300"}, {"speed", "40"}, {"policy", "accumulate"}};
        const RunRecord whole = measured(method, fast);
        EXPECT_THAT(whole.validity, IsEmpty());
        EXPECT_EQ(cellOf(whole, "invalid"), Value());
        EXPECT_EQ(cellOf(whole, "clipped"), Value(std::int64_t{0}));
        EXPECT_EQ(cellOf(whole, "world_edge_max"), Value(256.0));
        fast["depth"] = "12";  // the maximum depth
        const RunRecord cut = measured(method, fast);
        ASSERT_THAT(cut.validity, testing::SizeIs(2));
        EXPECT_THAT(cut.validity[0], HasSubstr("clipped is "));
        EXPECT_THAT(cut.validity[1], HasSubstr("mass_lost is "));
        EXPECT_EQ(cellOf(cut, "invalid"), Value(cut.validity[0] + "; " + cut.validity[1]));
        EXPECT_THAT(toJson(cut), HasSubstr("\"validity\": [\n    \"clipped is "));
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
    ParameterTexts few{{"particles", "500"}, {"preroll", "1"}};
    EXPECT_THAT(measured("plugin_particles", few).validity, testing::ElementsAre(HasSubstr("alive_deviation is ")));
    few["preroll"] = "6";
    EXPECT_THAT(measured("plugin_particles", few).validity, IsEmpty());
}

TEST_F(InvalidRun, HasAPressureThatRanOutOfCycles) {
    if (!hasMethod("grid_fluid")) GTEST_SKIP() << "no fluid here";
    ParameterTexts fluid{{"fluid", "plume"}, {"grid", "16x8x8"}, {"preroll", "0.1"}};
    const RunRecord solved = measured("grid_fluid", fluid);
    EXPECT_THAT(solved.validity, IsEmpty());
    EXPECT_EQ(cellOf(solved, "pressure_unsolved"), Value(std::int64_t{0}));
    fluid["tolerance"] = "1e-7";  // below the precision of floats
    EXPECT_THAT(measured("grid_fluid", fluid).validity, testing::ElementsAre(HasSubstr("pressure_unsolved is ")));
    fluid["pressure"] = "jacobi";
    const RunRecord swept = measured("grid_fluid", fluid);
    EXPECT_THAT(swept.validity, IsEmpty());
    EXPECT_EQ(cellOf(swept, "pressure_unsolved"), Value());
}

}  // namespace
}  // namespace dustbench::bench
