#include "bench/view/viewer.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <limits>
#include <set>

#include "bench/measure/clock.h"
#include "methods/contract/registry.h"
#include "methods/kit/draw/read_back.h"
#include "methods/kit/files/data_folder.h"
#include "methods/kit/testing/test_folder.h"

namespace dustbench::view {
namespace {

using ::testing::HasSubstr;

TEST(Keys, EachHasOneMeaningAndEveryActionAKey) {
    std::set<std::pair<Key, bool>> seen;
    std::set<Action> actions;
    for (const KeyBinding& binding : keyBindings()) {
        EXPECT_TRUE(seen.emplace(binding.key, binding.control).second) << binding.name;
        EXPECT_EQ(actionOf(binding.key, binding.control), binding.action);
        actions.insert(binding.action);
        EXPECT_EQ(binding.name.empty(), binding.help.empty());
    }
    EXPECT_EQ(actions.size(), static_cast<std::size_t>(Action::quit) + 1);
    EXPECT_EQ(actionOf(Key::z, true), std::nullopt);
}

class ViewerTest : public testing::Test {
 protected:
    ViewState small() const {
        ViewState state;
        state.size = {64, 48};
        state.world = {{"particles", "300"}, {"preroll", "0.2"}};
        state.a.method = methods().front().id;
        return state;
    }
    [[nodiscard]] std::filesystem::path saved() const { return folder_.path() / "saved"; }
    static std::string contentOf(const std::filesystem::path& file) {
        std::ifstream stream(file, std::ios::binary);
        return {std::istreambuf_iterator<char>(stream), {}};
    }

    gpu::Device device_;
    TestFolder folder_;
};

TEST_F(ViewerTest, DrivesByHeldKeysAndSavesADriveThatIsTheSame) {
    ViewState state = small();
    state.drive = keyboardDrive;
    Viewer viewer(state, device_, saved());
    viewer.advance(1e9);
    viewer.press(Key::up, false);
    viewer.press(Key::a, false);
    for (int n = 0; n < 60; ++n) viewer.advance();
    const double heading = viewer.session().world().state().vehicle.heading;
    EXPECT_GT(viewer.session().world().state().vehicle.speed, 2);
    EXPECT_GT(heading, 0.01);
    viewer.release(Key::a);
    viewer.release(Key::up);
    viewer.press(Key::down, false);
    for (int n = 0; n < 60; ++n) viewer.advance();
    EXPECT_LT(viewer.session().world().state().vehicle.speed, 0.1);
    viewer.press(Key::r, false);
    EXPECT_THAT(viewer.message(), HasSubstr("drive.csv"));

    Viewer again(viewer.session().replayOf((saved() / "drive.csv").string()), device_, saved());
    again.paused = true;
    again.advance(1e9);
    EXPECT_EQ(again.session().frame(), viewer.session().frame());
    EXPECT_EQ(again.session().world().stateHash(), viewer.session().world().stateHash());
}

TEST(Pad, EachButtonHasOneMeaning) {
    std::set<PadButton> seen;
    for (const PadBinding& binding : padBindings()) EXPECT_TRUE(seen.insert(binding.button).second) << binding.name;
    EXPECT_EQ(seen.size(), padButtonCount);
}

TEST_F(ViewerTest, AGamepadDrivesAndItsButtonsActOnce) {
    ViewState state = small();
    state.drive = keyboardDrive;
    state.b = HalfState{methods().back().id, {}};
    Viewer viewer(state, device_, saved());
    viewer.advance(1e9);
    PadState pad;
    pad.rightTrigger = 0.5f;
    pad.stickRight = 0.05f;  // at rest
    viewer.usePad(pad);
    EXPECT_EQ(viewer.session().input().throttle, 0.5);
    EXPECT_EQ(viewer.session().input().steer, 0);
    pad.stickRight = -0.75f;
    viewer.usePad(pad);
    EXPECT_EQ(viewer.session().input().steer, 0.75);
    viewer.press(Key::right, false);  // the keys come first
    EXPECT_EQ(viewer.session().input().steer, -1);
    viewer.release(Key::right);
    for (int n = 0; n < 60; ++n) viewer.advance();
    EXPECT_GT(viewer.session().world().state().vehicle.speed, 1);
    EXPECT_GT(viewer.session().world().state().vehicle.heading, 0.01);
    pad.buttons[static_cast<std::size_t>(PadButton::start)] = true;
    for (int n = 0; n < 4; ++n) viewer.usePad(pad);
    EXPECT_TRUE(viewer.paused);
    pad.buttons = {};
    viewer.usePad(pad);
    EXPECT_TRUE(viewer.paused);
    viewer.split.shown = Shown::a;
    pad.buttons[static_cast<std::size_t>(PadButton::south)] = true;
    viewer.usePad(pad);
    EXPECT_EQ(viewer.settingsNow().shown, Shown::b);
    viewer.usePad({});
    EXPECT_EQ(viewer.settingsNow().shown, Shown::a);
    EXPECT_EQ(viewer.session().input().throttle, 0);
    pad.stickRight = std::numeric_limits<float>::quiet_NaN();
    viewer.usePad(pad);
    EXPECT_EQ(viewer.session().input().steer, 0);
}

TEST_F(ViewerTest, PausesStepsAndBeginsAnew) {
    Viewer viewer(small(), device_, saved());
    viewer.advance(1e9);
    EXPECT_EQ(viewer.session().frame(), 0);
    viewer.advance();
    EXPECT_EQ(viewer.session().frame(), 1);
    viewer.press(Key::period, false);  // only while paused
    EXPECT_EQ(viewer.session().frame(), 1);
    viewer.press(Key::space, false);
    viewer.advance();
    EXPECT_EQ(viewer.session().frame(), 1);
    viewer.press(Key::period, false);
    EXPECT_EQ(viewer.session().frame(), 2);
    viewer.press(Key::b, false);
    viewer.advance(1e9);
    EXPECT_EQ(viewer.session().frame(), 0);
    EXPECT_FALSE(viewer.wantsToQuit());
    viewer.press(Key::q, true);
    EXPECT_TRUE(viewer.wantsToQuit());
}

TEST_F(ViewerTest, SlowMotionIsAStepInTwoFourAndEightFrames) {
    Viewer viewer(small(), device_, saved());
    viewer.advance(1e9);
    for (const int slowness : {2, 4, 8, 1}) {
        viewer.press(Key::comma, false);
        EXPECT_EQ(viewer.slowness, slowness);
        const std::int64_t frame = viewer.session().frame();
        for (int n = 0; n < 16; ++n) viewer.advance();
        EXPECT_EQ(viewer.session().frame(), frame + 16 / slowness);
    }
    Viewer atOnce(small(), device_, saved());  // the same states, only later
    atOnce.advance(1e9);
    while (atOnce.session().frame() < viewer.session().frame()) atOnce.advance();
    EXPECT_EQ(atOnce.session().world().stateHash(), viewer.session().world().stateHash());
}

TEST_F(ViewerTest, DrawingIsPausedApartFromTheWorld) {
    Viewer viewer(small(), device_, saved());
    viewer.advance(1e9);
    const std::vector<glm::vec4> first = draw::readBack(viewer.image()).pixels;
    viewer.press(Key::space, true);
    EXPECT_TRUE(viewer.drawingPaused);
    EXPECT_FALSE(viewer.paused);
    for (int n = 0; n < 5; ++n) viewer.advance();
    EXPECT_EQ(viewer.session().frame(), 5);
    EXPECT_EQ(viewer.session().drawnFrame(), 0);
    EXPECT_THAT(viewer.stamp(), HasSubstr("frame 0:"));
    EXPECT_EQ(draw::readBack(viewer.image()).pixels, first);
    viewer.turnCamera(0.3, 0);  // must be visible
    viewer.advance();
    EXPECT_EQ(viewer.session().drawnFrame(), 6);
    viewer.press(Key::n, false);
    viewer.advance();
    EXPECT_THAT(viewer.stamp(), HasSubstr("frame 7:"));
    viewer.advance();
    EXPECT_EQ(viewer.session().drawnFrame(), 7);
    viewer.press(Key::space, true);
    viewer.advance();
    EXPECT_EQ(viewer.session().drawnFrame(), viewer.session().frame());
    viewer.press(Key::space, false);  // pausing the world does not pause drawing
    viewer.press(Key::n, false);
    viewer.advance();
    EXPECT_EQ(viewer.session().drawnFrame(), 9);
}

TEST_F(ViewerTest, CostsAreThoseOfWhatAFrameDid) {
    ViewState state = small();
    state.b = HalfState{methods().back().id, {}};
    Viewer viewer(state, device_, saved());
    viewer.advance(1e9);
    EXPECT_TRUE(viewer.costs().empty());  // the preroll
    const std::int64_t start = measure::steadyNow();
    for (int n = 0; n < 4; ++n) viewer.advance();
    ASSERT_EQ(viewer.costs().size(), 4u);
    double whole = 0;
    for (const FrameCost& frame : viewer.costs()) {
        EXPECT_GT(frame.world, 0);
        for (const HalfCost& half : frame.halves) {
            EXPECT_GT(sum(half.update), 0);
            EXPECT_GT(sum(half.draw), 0);
        }
        whole += frame.methodsMs() + frame.window;
    }
    EXPECT_LE(whole, static_cast<double>(measure::steadyNow() - start) / 1e6);
    EXPECT_EQ(viewer.costs().back().window, 0);  // has not ended yet
    for (std::size_t n = 0; n < 3; ++n) EXPECT_GT(viewer.costs()[n].window, 0) << n;
    viewer.paused = true;
    viewer.advance();
    EXPECT_EQ(viewer.costs().back().world, 0);
    EXPECT_EQ(sum(viewer.costs().back().halves[1].update), 0);
    EXPECT_GT(sum(viewer.costs().back().halves[1].draw), 0);
    viewer.paused = false;
    viewer.drawingPaused = true;
    viewer.advance();
    EXPECT_EQ(sum(viewer.costs().back().halves[0].draw), 0);
    EXPECT_GT(sum(viewer.costs().back().halves[0].update), 0);
    for (std::size_t n = 0; n < 2 * Viewer::keptFrames; ++n) viewer.advance();
    EXPECT_EQ(viewer.costs().size(), Viewer::keptFrames);
}

TEST_F(ViewerTest, AFileThatBreaksMeanwhileIsAMessage) {
    const auto scene = folder_.path() / "mine.toml";
    std::filesystem::copy_file(files::dataPath("scenes/wind_tunnel.toml"), scene);
    ViewState state = small();
    state.scene = scene.string();
    Viewer viewer(state, device_, saved());
    viewer.advance();
    folder_.write("mine.toml", "gravity = nothing\n");
    viewer.press(Key::b, false);
    EXPECT_THAT(viewer.message(), HasSubstr("mine.toml"));
    folder_.write("saved", "not a folder");
    viewer.press(Key::s, true);
    EXPECT_THAT(viewer.message(), HasSubstr("saved"));
    viewer.advance();
    EXPECT_EQ(viewer.state().scene, scene.string());
}

TEST_F(ViewerTest, FlipsInPlaceWhileTheKeyIsHeld) {
    ViewState state = small();
    state.b = HalfState{methods().back().id, {}};
    Viewer viewer(state, device_, saved());
    viewer.paused = true;
    viewer.split.shown = Shown::a;
    viewer.advance(1e9);
    const auto pictureOf = [&](Half half) { return draw::readBack(viewer.session().picture(half)).pixels; };
    EXPECT_EQ(draw::readBack(viewer.image()).pixels, pictureOf(Half::a));
    viewer.press(Key::f, false);
    viewer.advance();
    EXPECT_EQ(draw::readBack(viewer.image()).pixels, pictureOf(Half::b));
    viewer.release(Key::f);
    viewer.advance();
    EXPECT_EQ(draw::readBack(viewer.image()).pixels, pictureOf(Half::a));
    EXPECT_NE(pictureOf(Half::a), pictureOf(Half::b));
}

TEST_F(ViewerTest, ACameraPathOfKeysIsSavedAndFollowed) {
    Viewer viewer(small(), device_, saved());
    viewer.press(Key::k, true);
    EXPECT_THAT(viewer.message(), HasSubstr("no keys; press K"));
    viewer.advance(1e9);
    std::vector<glm::dvec3> eyes;
    for (int key = 0; key < 3; ++key) {
        viewer.turnCamera(0.2, 0.1);
        eyes.push_back(viewer.session().world().view(4, 3).camera.eye);
        viewer.press(Key::k, false);
        for (int n = 0; n < 10; ++n) viewer.advance();
    }
    viewer.press(Key::k, true);
    const world::CameraPath path = world::CameraPath::parseFile(saved() / "camera_path.csv");
    ASSERT_EQ(path.keys().size(), 3u);
    for (std::size_t i = 0; i < 3; ++i) EXPECT_LT(glm::distance(path.keys()[i].eye, eyes[i]), 1e-9);
    EXPECT_NEAR(path.keys()[2].seconds - path.keys()[1].seconds, 10 * world::stepSeconds, 1e-9);
}

TEST_F(ViewerTest, TakesLinesAndTomlAndSaysWhatIsWrong) {
    Viewer viewer(small(), device_, saved());
    viewer.advance(1e9);
    viewer.press(Key::s, true);
    const std::string toml = contentOf(saved() / "state.toml");
    ViewState other = small();
    other.seed = 9;
    const std::string line = commandLine(other, Half::a, "o");
    viewer.applyText(line);
    EXPECT_EQ(viewer.message(), "");
    EXPECT_EQ(viewer.state().seed, 9u);
    viewer.applyText(toml);
    EXPECT_EQ(viewer.message(), "");
    EXPECT_EQ(viewer.state().seed, 1u);
    viewer.applyText("nonsense");
    EXPECT_THAT(viewer.message(), HasSubstr("pasted text:1: "));
    viewer.applyText("dustbench run --methods x");
    EXPECT_THAT(viewer.message(), HasSubstr("'--method'"));
    viewer.press(Key::c, true);
    EXPECT_EQ(viewer.takeCopied(), viewer.line(Half::a));
    EXPECT_EQ(viewer.takeCopied(), "");
}

TEST_F(ViewerTest, SavesThePictureThatItShows) {
    Viewer viewer(small(), device_, saved());
    viewer.paused = true;
    viewer.advance(1e9);
    viewer.press(Key::p, false);
    const pictures::Image file = pictures::readImage(saved() / "f000000.png");
    const pictures::Image shown = draw::readBack(viewer.image());
    for (std::size_t i = 0; i < shown.pixels.size(); ++i)
        ASSERT_NEAR(pictures::encodeSrgb(file.pixels[i].g), shown.pixels[i].g, 0.5 / 255);
}

TEST_F(ViewerTest, SavesTheLightOfThePictureBesideIt) {
    ViewState state = small();
    state.b = HalfState{methods().back().id, {}};
    Viewer viewer(state, device_, saved());
    viewer.paused = true;
    viewer.advance(1e9);
    for (const Shown shown : {Shown::a, Shown::b, Shown::sideBySide}) {
        viewer.split.shown = shown;
        viewer.split.stops = 1;  // only of the view
        viewer.advance();
        viewer.press(Key::p, false);
        const pictures::Image light = pictures::readImage(saved() / "f000000.exr");
        const pictures::Image a = viewer.session().image(Half::a), b = viewer.session().image(Half::b);
        ASSERT_EQ(light.width, shown == Shown::sideBySide ? 128 : 64);
        for (int y = 0; y < light.height; ++y)
            for (int x = 0; x < light.width; ++x) {
                const bool isB = shown == Shown::b || x >= 64;
                for (int channel = 0; channel < 3; ++channel)
                    ASSERT_NEAR(light.at(x, y)[channel], (isB ? b : a).at(x % 64, y)[channel], 1e-5f);
            }
        std::filesystem::remove(saved() / "f000000.exr");
    }
    viewer.split.shown = Shown::difference;
    viewer.advance();
    viewer.press(Key::p, false);
    EXPECT_FALSE(std::filesystem::exists(saved() / "f000000.exr"));
}

TEST_F(ViewerTest, SavesTheVolumeOfTheMoment) {
    if (std::ranges::none_of(methods(), [](const MethodInfo& info) { return info.id == "octree_search"; }))
        GTEST_SKIP() << "no octree here";
    ViewState state = small();
    state.frame = 3;
    state.a.method = "octree_search";
    Viewer viewer(state, device_, saved());
    viewer.paused = true;
    viewer.advance(1e9);
    viewer.press(Key::o, false);
    EXPECT_THAT(viewer.message(), HasSubstr("volumes/f000003 ("));
    const auto folder = saved() / "volumes" / "f000003";
    for (const char* file : {"f000003.vti", "f000003.htg", "f000003.vdb"})
        EXPECT_TRUE(std::filesystem::exists(folder / file)) << file;
    viewer.press(Key::o, false);  // again
    EXPECT_THAT(viewer.message(), HasSubstr("saved: "));
}

}  // namespace
}  // namespace dustbench::view
