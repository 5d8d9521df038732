// Scripted input on a surfaceless context: widgets are found by name, pictures are read from the framebuffer.
#include "bench/view/panels/viewer_panels.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <random>

#include "bench/view/panels/cost_panel.h"
#include "bench/view/panels/panels_fixture.h"
#include "bench/world/world.h"
#include "methods/contract/registry.h"

namespace dustbench::view {
namespace {

using testing::HasSubstr;
using testing::Not;

TEST_F(Panels, AreNotEmptyAndHide) {
    open(methods().front().id, methods().back().id);
    const double shown = brightShare(picture(), 0, 300);
    EXPECT_GT(shown, 0.02);
    EXPECT_LT(shown, 0.4);
    for (const char* widget : {"A", "B", "Wipe", "Resume", "Restart", "Camera", "Copy command", "world/particles"})
        EXPECT_TRUE(panels_->widgets().all().contains(widget)) << widget;
    viewer_->press(Key::h, false);
    frames(2);
    EXPECT_FALSE(panels_->widgets().all().contains("A"));
}

TEST_F(Panels, ShowThePictureAsItIs) {
    open(methods().front().id, "");
    viewer_->showsPanels = false;
    frames(2);
    // 96 × 72 is shown ninefold, in the middle.
    const pictures::Image window = picture(), image = draw::readBack(viewer_->image());
    const int left = (width - 9 * 96) / 2, top = (height - 9 * 72) / 2;
    for (int y = 0; y < 72; ++y)
        for (int x = 0; x < 96; ++x)
            ASSERT_EQ(glm::vec3(window.at(left + 9 * x + 4, top + 9 * y + 4)), glm::vec3(image.at(x, y)))
                << x << ' ' << y;
}

TEST_F(Panels, EverySliderAndSwitchOfAMethodChangesItsParameter) {
    int tried = 0;
    for (const MethodInfo& method : methods()) {
        const world::World plain("plain", "", ParameterValues(world::worldParameters()), 1);
        if (method.cannotTake && !method.cannotTake(plain.scene()).empty()) continue;
        open(method.id, "");
        for (const Parameter& parameter : method.parameters.all()) {
            const std::string widget = "a/" + parameter.name;
            if (at(widget).maximum.y > height - 40) break;  // the panel would have to be scrolled
            const std::string before = viewer_->line(Half::a);
            if (parameter.type == ParameterType::boolean)
                click(widget);
            else if (parameter.type == ParameterType::real)
                slide(widget, std::stod(parameter.initial) < 0.5 * (parameter.minimum + parameter.maximum) ? 1 : 0);
            else
                continue;
            ++tried;
            // Either it is set now, or the method says why it cannot be.
            EXPECT_TRUE(viewer_->state().a.parameters.contains(parameter.name) || !viewer_->message().empty())
                << method.id << " " << parameter.name;
            if (!viewer_->state().a.parameters.contains(parameter.name)) continue;
            EXPECT_THAT(viewer_->line(Half::a), HasSubstr("-P " + parameter.name + "="));
            click(widget + "/reset");
            EXPECT_EQ(viewer_->line(Half::a), before) << parameter.name;
        }
    }
    EXPECT_GT(tried, 10);
}

TEST_F(Panels, ParametersOfBAndOfTheWorldAreTheirOwn) {
    if (!hasMethod("billboard") || !hasMethod("octree_search")) GTEST_SKIP() << "one of the methods is missing";
    open("billboard", "octree_search");
    click("Parameters of A");  // closed, so that the others come into view
    EXPECT_FALSE(panels_->widgets().all().contains("a/soft"));
    const ViewState before = viewer_->state();
    slide("b/levels", 0.5f);
    EXPECT_EQ(viewer_->state().b->parameters.count("levels"), 1u) << viewer_->message();
    EXPECT_EQ(viewer_->state().a, before.a);
    EXPECT_EQ(viewer_->state().world, before.world);
    click("Parameters of B");
    slide("world/speed", 0.5f);
    ASSERT_EQ(viewer_->state().world.count("speed"), 1u) << viewer_->message();
    EXPECT_NEAR(std::stod(viewer_->state().world.at("speed")), 30, 2);
    EXPECT_EQ(viewer_->state().a, before.a);
    click("world/speed/reset");
    EXPECT_EQ(viewer_->state().world, before.world);
}

TEST_F(Panels, ButtonsDoWhatTheySay) {
    open(methods().front().id, methods().front().id);
    click("Resume");
    EXPECT_FALSE(viewer_->paused);
    click("Pause");
    EXPECT_TRUE(viewer_->paused);
    const std::int64_t frame = viewer_->session().frame();
    click("Step");
    EXPECT_EQ(viewer_->session().frame(), frame + 1);
    click("Difference");
    EXPECT_EQ(viewer_->split.shown, Shown::difference);
    click("B only");
    EXPECT_EQ(viewer_->split.shown, Shown::b);
    click("Wipe");
    slide("Divider", 1);
    EXPECT_GT(viewer_->split.divider, 0.9f);
    click("Help");
    EXPECT_TRUE(viewer_->showsHelp);
    click("Copy command");
    EXPECT_EQ(panels_->canvas().clipboard(), viewer_->line(Half::a));
    EXPECT_THAT(panels_->canvas().clipboard(), HasSubstr("dustbench run --method " + methods().front().id));
    click("Save picture");
    EXPECT_THAT(viewer_->message(), HasSubstr("saved: "));
    EXPECT_FALSE(std::filesystem::is_empty(folder_.path() / "saved"));
}

TEST_F(Panels, KeysWalkThroughThePanelOnlyWhenAsked) {
    open(methods().front().id, "");
    const auto tap = [&](Key key) {
        for (const bool down : {true, false}) {
            input_.keys[static_cast<std::size_t>(key)] = down;
            frames(2);
        }
    };
    click("Resume");
    click("Pause");  // the panel has the focus
    const pictures::Image before = picture();
    for (const Key key : {Key::down, Key::down, Key::up}) tap(key);
    EXPECT_EQ(picture().pixels, before.pixels);
    EXPECT_FALSE(panels_->takesKeyboard());
    viewer_->press(Key::tab, false);
    for (const Key key : {Key::down, Key::down, Key::up}) tap(key);
    EXPECT_NE(picture().pixels, before.pixels);
    EXPECT_TRUE(panels_->takesKeyboard());
}

TEST_F(Panels, APastedLineIsTheState) {
    open(methods().front().id, "");
    panels_->canvas().setClipboard("dustbench run --method " + methods().back().id +
                                   " --seed 42 --size 96x72 --frames 3 -P preroll=0.2 -P particles=200 --out o");
    click("Paste");
    EXPECT_EQ(viewer_->message(), "");
    EXPECT_EQ(viewer_->state().seed, 42u);
    EXPECT_EQ(viewer_->state().a.method, methods().back().id);
    panels_->canvas().setClipboard("dustbench run --method nothing");
    click("Paste");
    EXPECT_THAT(viewer_->message(), HasSubstr("unknown method 'nothing'"));
    EXPECT_EQ(viewer_->state().seed, 42u);
}

TEST_F(Panels, TheMouseOverThePictureMovesDividerAndCamera) {
    open(methods().front().id, methods().front().id);
    const glm::vec2 middle(312 + (width - 312) / 2, height / 2);
    clickAt(middle + glm::vec2(60, 0));
    const float divider = viewer_->split.divider;
    EXPECT_GT(divider, 0.5f);
    input_.mouse = middle;
    frames(1);
    input_.buttons[1] = true;
    frames(1);
    input_.mouse += glm::vec2(40, 0);
    frames(1);
    input_.buttons[1] = false;
    frames(1);
    EXPECT_THAT(viewer_->line(Half::a),
                ::testing::AnyOf(HasSubstr("--camera-path 0,"), HasSubstr("--camera-path '0,")));
    EXPECT_EQ(viewer_->split.divider, divider);
    viewer_->press(Key::c, false);
    EXPECT_THAT(viewer_->line(Half::a), Not(HasSubstr("--camera-path")));
}

TEST(PanelPicture, ShowsTheStateThatItIsGiven) {
    ViewState state;
    state.size = {160, 120};
    state.world = {{"particles", "300"}, {"preroll", "0.2"}};
    state.a.method = methods().front().id;
    const pictures::Image image = panelPicture(state, {}, 640, 400);
    EXPECT_EQ(image.width, 640);
    EXPECT_EQ(image.height, 400);
    EXPECT_GT(brightShare(image, 0, 300), 0.01);
}

// --- Views, costs and pace; random input; windows of many sizes

TEST_F(Panels, TheExactPictureIsChosenFromTheListAndHasItsNumbers) {
    open(methods().front().id, "");
    click("B");
    click("B/exact");
    ASSERT_EQ(viewer_->state().b, (HalfState{exactPicture, {}})) << viewer_->message();
    EXPECT_EQ(viewer_->split.shown, Shown::wipe);
    for (int n = 0; n < 2; ++n) viewer_->advance();
    frames(2);
    ASSERT_TRUE(viewer_->session().isCurrent(Half::b));
    click("Ground truth in every frame");
    EXPECT_TRUE(viewer_->exactEveryFrame);
    for (const char* view : {"Side by side", "FLIP", "Difference", "B only", "Wipe"}) {
        const pictures::Image before = picture();
        click(view);
        viewer_->advance();
        input_.mouse = glm::vec2(-1);
        frames(2);
        EXPECT_NE(picture().pixels, before.pixels) << view;
        EXPECT_EQ(viewer_->message(), "") << view;
    }
}

TEST_F(Panels, ChannelExposureAndZoomAreAtHand) {
    open(methods().front().id, methods().front().id);
    for (const auto& [word, channel] : channelChoices.all()) {
        if (channel == Channel::picture) continue;
        click("Channel");
        click("Channel/" + std::string(word));
        EXPECT_EQ(viewer_->split.channel, channel);
        viewer_->advance();
        frames(2);
    }
    slide("Exposure", 1);
    EXPECT_GT(viewer_->split.stops, 7);
    slide("Zoom", 1);
    EXPECT_LT(viewer_->split.extent.x, 0.2f);
    EXPECT_GT(viewer_->split.origin.x, 0.3f);
}

/// Number of pixels of a rectangle with this colour.
int countOf(const pictures::Image& image, const PanelRectangle& where, glm::ivec3 colour) {
    int count = 0;
    for (int y = static_cast<int>(where.minimum.y); y < static_cast<int>(where.maximum.y); ++y)
        for (int x = static_cast<int>(where.minimum.x); x < static_cast<int>(where.maximum.x); ++x)
            count += glm::ivec3(glm::round(255.0f * glm::vec3(image.at(x, y)))) == colour;
    return count;
}

/// Number of pixels of a stage in a half's chart: one column per frame, cut off above the scale.
double stackedArea(const Viewer& viewer, std::size_t half, std::string_view stage, const PanelRectangle& stack) {
    const glm::dvec2 size = stack.maximum - stack.minimum;
    const auto shown = [&, scale = stackScaleMs(viewer)](double ms) { return std::min(ms / scale, 1.0) * size.y; };
    double height = 0;
    for (const FrameCost& frame : viewer.costs()) {
        double bottom = 0;
        for (std::size_t s = 0; s < stageNames.size(); ++s) {
            const double top = bottom + frame.halves[half].update[s] + frame.halves[half].draw[s];
            if (stageNames[s] == stage) height += shown(top) - shown(bottom);
            bottom = top;
        }
    }
    return height * size.x / static_cast<double>(Viewer::keptFrames);
}

TEST_F(Panels, CostsAreStackedByStageAndMemoryByStructure) {
    open(methods().front().id, methods().front().id);
    for (std::size_t n = 0; n < Viewer::keptFrames; ++n) viewer_->advance();
    frames(2);
    EXPECT_LT(at("Memory").minimum.y, at("Costs").maximum.y + 30);
    click("Costs");
    const glm::ivec3 scene(86, 180, 233), draw(213, 94, 0);
    for (const std::size_t half : {0, 1}) {
        const PanelRectangle stack = at(half == 0 ? "Costs/stack of A" : "Costs/stack of B");
        const float rounding = 0.5f * (stack.maximum.x - stack.minimum.x);  // half a pixel a column, at most
        EXPECT_NEAR(countOf(picture(), stack, scene), stackedArea(*viewer_, half, "scene", stack), rounding) << half;
        EXPECT_NEAR(countOf(picture(), stack, draw), stackedArea(*viewer_, half, "draw", stack), rounding) << half;
    }
    const auto isCut = [&](const FrameCost& frame) {
        return std::ranges::max(frame.halves, {}, &HalfCost::totalMs).totalMs() > stackScaleMs(*viewer_);
    };
    EXPECT_LE(std::ranges::count_if(viewer_->costs(), isCut), 2 * 0.05 * Viewer::keptFrames);  // of either half
    const PanelRectangle costs = at("Costs");
    click("Costs");
    EXPECT_LT(at("Memory").minimum.y, costs.maximum.y + 30);
    const float before = at("Parameters of A").minimum.y;
    click("Memory");
    EXPECT_GT(at("Parameters of A").minimum.y, before + 60);
}

TEST_F(Panels, SpeedAndDrawingAreAtHand) {
    open(methods().front().id, "");
    click("Speed");
    click("Speed/1/4");
    EXPECT_EQ(viewer_->slowness, 4);
    click("Drawing");
    EXPECT_TRUE(viewer_->drawingPaused);
    click("Drawing");
    EXPECT_FALSE(viewer_->drawingPaused);
}

TEST_F(Panels, TheWheelWithCtrlEnlargesAroundTheCursor) {
    open(methods().front().id, "");
    const std::string line = viewer_->line(Half::a);
    input_.mouse = {312 + (width - 312) / 2, height / 2};
    frames(2);
    input_.control = true;
    input_.wheel = 5;
    frames(1);
    EXPECT_NEAR(viewer_->split.extent.x, std::pow(0.9, 5), 1e-5);
    EXPECT_NEAR(viewer_->split.origin.x, (1 - std::pow(0.9, 5)) / 2, 0.02);
    EXPECT_EQ(viewer_->line(Half::a), line);  // the camera stays
    input_.buttons[0] = true;
    frames(1);
    input_.mouse.x -= 1000;
    frames(1);
    input_.mouse.x += 1020;
    frames(1);
    EXPECT_EQ(viewer_->line(Half::a), line);
    input_.buttons[0] = input_.control = false;
    const pictures::Image without = picture();
    frames(1);
    input_.wheel = 1;
    frames(1);
    EXPECT_NE(viewer_->line(Half::a), line);
}

int numberIn(const char* variable, int initial) {
    const char* const text = std::getenv(variable);
    return text ? std::stoi(text) : initial;
}
/// Few by default; `DUSTBENCH_RANDOM_INPUTS=10000` for all.
int randomInputs() {
    return numberIn("DUSTBENCH_RANDOM_INPUTS", 500);
}
unsigned randomSeed() {
    return static_cast<unsigned>(numberIn("DUSTBENCH_RANDOM_SEED", 17));
}

TEST_F(Panels, RandomInputDoesNotBreakThem) {
    open(methods().front().id, methods().back().id);
    const unsigned seed = randomSeed();
    SCOPED_TRACE(seed);
    std::mt19937 random(seed);
    const auto below = [&](int limit) { return static_cast<int>(random() % static_cast<unsigned>(limit)); };
    const int inputs = randomInputs();
    for (int n = 0; n < inputs; ++n) {
        // Above the parameters, which could request ten million particles, or over the picture.
        input_.mouse =
            below(2) == 0 ? glm::vec2(below(width), below(200)) : glm::vec2(320 + below(width - 320), below(height));
        for (bool& button : input_.buttons) button = below(3) == 0;
        input_.wheel = static_cast<float>(below(5) - 2);
        input_.control = below(4) == 0;
        const Key key = static_cast<Key>(below(static_cast<int>(keyCount)));
        input_.keys[static_cast<std::size_t>(key)] = below(2) == 0;
        if (below(4) == 0) input_.text = "1x.";
        if (key != Key::q) below(2) == 0 ? viewer_->press(key, below(4) == 0) : viewer_->release(key);
        if (n % 50 == 0) {
            ViewState state = viewer_->state();  // half B is alternately a method, the ground truth, none
            state.b = HalfState{methods().back().id, {}};
            if (n % 150 == 50) state.b = HalfState{exactPicture, {}};
            if (n % 150 == 100) state.b.reset();
            viewer_->apply(state);
        }
        frames(1);
        if (n % 8 == 0) viewer_->advance(0.01);
        ASSERT_FALSE(viewer_->wantsToQuit());
    }
}

TEST_F(Panels, FitWindowsFromTinyToFourThousandPixels) {
    open(methods().front().id, methods().front().id);
    for (const glm::ivec2 size :
         {glm::ivec2(320, 200), glm::ivec2(1, 1), glm::ivec2(1280, 720), glm::ivec2(3840, 2160)}) {
        const gpu::Texture texture = gpu::Texture::make2D(device_, "window", gpu::Format::rgba8, size.x, size.y);
        const gpu::Framebuffer target(device_, "window", &texture, nullptr);
        for (int n = 0; n < 2; ++n) panels_->draw(*viewer_, target, size.x, size.y, input_);
        const pictures::Image image = draw::readBack(texture);
        if (size.x > 1) {
            EXPECT_GT(brightShare(image, 0, 290), 0.01) << size.x;
        }
        viewer_->showsPanels =
            false;  // then the picture reaches two edges, if it is enlarged by whole steps or reduced
        for (int n = 0; n < 2; ++n) panels_->draw(*viewer_, target, size.x, size.y, input_);
        if (size.x > 1) {
            EXPECT_GT(brightShare(draw::readBack(texture), 0, size.x), 0.05) << size.x;
        }
        viewer_->showsPanels = true;
    }
}

}  // namespace
}  // namespace dustbench::view
