// Views, costs and pace in the panel, random input, and windows of many sizes.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <random>

#include "bench/view/panels/cost_panel.h"
#include "bench/view/panels/panels_fixture.h"
#include "methods/contract/registry.h"

namespace dustbench::bench {
namespace {

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
}  // namespace dustbench::bench
