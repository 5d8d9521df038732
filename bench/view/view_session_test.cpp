#include "bench/view/view_session.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <random>

#include "bench/run/measured_run.h"
#include "methods/contract/registry.h"
#include "methods/kit/testing/test_folder.h"

namespace dustbench::view {
namespace {

using ::testing::HasSubstr;

constexpr float sameColour = 0.5f / 255;

ViewState smallView(const std::string& method) {
    ViewState state;
    state.size = {64, 48};
    state.world = {{"particles", "300"}, {"preroll", "0.3"}};
    state.a.method = method;
    return state;
}
void goOn(ViewSession& session) {
    while (session.stepsToGo() > 0) session.step();
    session.draw();
}
bool takes(const MethodInfo& method, const world::World& world) {
    return !method.cannotTake || method.cannotTake(world.scene()).empty();
}
bool hasMethod(std::string_view id) {
    return std::ranges::any_of(methods(), [id](const MethodInfo& info) { return info.id == id; });
}
/// A run has a context of its own, so no other may be in use.
results::RunRecord runOfLine(const std::string& line, const std::filesystem::path& folder) {
    return run::measureRun(runOf(stateOfCommandLine(line), Half::a), folder, {},
                           [](std::string_view, std::int64_t, std::int64_t) {});
}

class Session : public testing::Test {
 protected:
    gpu::Device device_;
};

float maximumDifference(const pictures::Image& a, const pictures::Image& b) {
    EXPECT_EQ(a.pixels.size(), b.pixels.size());
    float maximum = 0;
    for (std::size_t i = 0; i < std::min(a.pixels.size(), b.pixels.size()); ++i)
        for (int channel = 0; channel < 3; ++channel)
            maximum = std::max(maximum, std::abs(a.pixels[i][channel] - b.pixels[i][channel]));
    return maximum;
}

TEST(SessionAndRun, ShowThePictureOfTheCommandLine) {
    const TestFolder folder;
    for (const MethodInfo& method : methods()) {
        ViewState state = smallView(method.id);
        state.drive = "slalom";
        state.seed = 5;
        state.frame = 7;
        state.world["camera"] = "wheel";
        if (!takes(method, world::World(state.scene, state.drive, ParameterValues(world::worldParameters()), 1)))
            continue;
        std::string line, hash;
        pictures::Image shown;
        {
            gpu::Device device;
            ViewSession session(state, device);
            goOn(session);
            ASSERT_EQ(session.frame(), 7);
            line = commandLine(session.state(), Half::a, "o");
            hash = fmt::format("{:016x}", session.world().stateHash());
            shown = session.host(Half::a).picture();
        }
        EXPECT_EQ(runOfLine(line, folder.path()).stateHash, hash) << method.id;
        const pictures::Image saved = pictures::readImage(folder.path() / "images" / "f000007.exr");
        EXPECT_LE(maximumDifference(shown, saved), sameColour) << method.id;
    }
}

TEST_F(Session, AHalfIsWhatItIsAlone) {
    if (!hasMethod("billboard") || !hasMethod("octree_search")) GTEST_SKIP() << "one of the methods is missing";
    ViewState alone = smallView("octree_search");
    alone.frame = 5;
    ViewState both = alone;
    both.b = HalfState{"billboard", {{"soft", "on"}}};
    ViewSession one(alone, device_), two(both, device_);
    goOn(one);
    goOn(two);
    EXPECT_EQ(maximumDifference(one.host(Half::a).picture(), two.host(Half::a).picture()), 0);
    EXPECT_GT(maximumDifference(two.host(Half::a).picture(), two.host(Half::b).picture()), 0.01f);
    EXPECT_EQ(one.host(Half::a).gpuBytes(), two.host(Half::a).gpuBytes());
    EXPECT_EQ(one.world().stateHash(), two.world().stateHash());
    const HalfCost cost = two.cost(Half::b);
    for (const Stage stage : {Stage::scene, Stage::draw}) {
        EXPECT_GT(cost.draw[static_cast<std::size_t>(stage)], 0);
        EXPECT_EQ(cost.update[static_cast<std::size_t>(stage)], 0);
    }
    EXPECT_GT(cost.update[static_cast<std::size_t>(Stage::build)], 0);
    EXPECT_EQ(sum(cost.update) + sum(cost.draw), cost.totalMs());
    EXPECT_GT(two.worldMs(), 0);
}

TEST_F(Session, AMethodAgainstItselfIsTheSamePicture) {
    const std::string method = methods().front().id;
    ViewState state = smallView(method);
    state.b = state.a;
    state.frame = 3;
    ViewSession session(state, device_);
    goOn(session);
    EXPECT_EQ(maximumDifference(session.host(Half::a).picture(), session.host(Half::b).picture()), 0);
}

TEST_F(Session, ANewHalfAndAnotherCameraLeaveTheWorldGoingOn) {
    if (!hasMethod("billboard") || !hasMethod("octree_search")) GTEST_SKIP() << "one of the methods is missing";
    ViewState state = smallView("billboard");
    state.frame = 10;
    ViewSession session(state, device_);
    goOn(session);
    const std::uint64_t before = session.world().stateHash();
    const run::MethodHost* kept = &session.host(Half::a);
    state.b = HalfState{"octree_search", {}};
    state.cameraPath = "0,30,4,24,0,1,0,50";
    session.set(state);
    session.draw();
    EXPECT_EQ(session.world().stateHash(), before);
    EXPECT_EQ(&session.host(Half::a), kept);
    EXPECT_TRUE(session.isSinceStart(Half::a));
    EXPECT_FALSE(session.isSinceStart(Half::b));
    EXPECT_EQ(session.world().view(4, 3).camera.eye, glm::dvec3(30, 4, 24));
    state.b.reset();
    state.cameraPath.clear();
    session.set(state);
    EXPECT_FALSE(session.has(Half::b));
    EXPECT_NE(session.world().view(4, 3).camera.eye, glm::dvec3(30, 4, 24));
    state.seed = 9;
    session.set(state);
    EXPECT_LT(session.frame(), 0);
    goOn(session);
    EXPECT_EQ(session.frame(), 10);
    EXPECT_NE(session.world().stateHash(), before);
}

TEST_F(Session, AnErrorChangesNothing) {
    ViewState state = smallView(methods().front().id);
    state.frame = 2;
    ViewSession session(state, device_);
    goOn(session);
    const ViewState before = session.state();
    for (const auto& spoil : std::vector<std::function<void(ViewState&)>>{
             [](ViewState& s) { s.scene = "plaine"; }, [](ViewState& s) { s.a.method = "none"; },
             [](ViewState& s) {
                 s.b = HalfState{"none", {}};
             },
             [](ViewState& s) { s.cameraPath = "here"; }, [](ViewState& s) { s.world["particles"] = "many"; },
             [](ViewState& s) { s.a.parameters["nothing"] = "1"; }}) {
        ViewState spoiled = before;
        spoil(spoiled);
        EXPECT_NE(inputError([&] { session.set(spoiled); }), "");
        EXPECT_EQ(session.state(), before);
        session.draw();
    }
    session.step();
    EXPECT_EQ(session.frame(), 3);
}

TEST_F(Session, RestartedItDoesTheSameAgain) {
    ViewState state = smallView(methods().front().id);
    state.frame = 6;
    ViewSession session(state, device_);
    goOn(session);
    const std::uint64_t hash = session.world().stateHash();
    session.step();
    session.restart();
    EXPECT_EQ(session.stepsToGo(), 18 + 1);
    while (session.frame() < 6) session.step();
    EXPECT_EQ(session.world().stateHash(), hash);
}

TEST(SessionAndRun, EndARecordedDriveInTheSameState) {
    const TestFolder folder;
    for (const unsigned seed : {1u, 2u, 3u}) {
        std::mt19937 random(seed);
        ViewState state = smallView(methods().front().id);
        state.drive = keyboardDrive;
        state.seed = seed;
        state.world["speed"] = "20";  // without effect on a car driven by keyboard
        std::string line, hash;
        {
            gpu::Device device;
            ViewSession session(state, device);
            EXPECT_THROW((void)session.replayOf("x.csv"), std::logic_error);
            while (session.frame() < 120) {
                if (random() % 10 == 0)
                    session.input() = {1.0 * (random() % 3 > 0), 1.0 * (random() % 6 == 0), 1.0 * (random() % 3) - 1};
                session.step();
            }
            EXPECT_GT(session.world().state().vehicle.speed, 0.5);
            const auto file = folder.write("drive.csv", session.recordedDrive());
            line = commandLine(session.replayOf(file.string()), Half::a, "o");
            hash = fmt::format("{:016x}", session.world().stateHash());
        }
        EXPECT_EQ(runOfLine(line, folder.path()).stateHash, hash) << line;
    }
}

TEST_F(Session, RefusesASceneThatItsMethodCannotTake) {
    for (const MethodInfo& method : methods()) {
        const world::World world("plain", "", ParameterValues(world::worldParameters()), 1);
        if (takes(method, world)) continue;
        EXPECT_THAT(inputError([&] { ViewSession(smallView(method.id), device_); }),
                    HasSubstr("cannot show scene 'plain'"));
    }
}

}  // namespace
}  // namespace dustbench::view
