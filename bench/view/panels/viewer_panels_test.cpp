// A script of input on a surfaceless context: widgets are found by name, pictures come out of the framebuffer.
#include "bench/view/panels/viewer_panels.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "bench/scene/world.h"
#include "bench/view/panels/panel_picture.h"
#include "methods/contract/registry.h"
#include "methods/kit/draw/read_back.h"
#include "methods/kit/testing/test_folder.h"

namespace dustbench::bench {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

constexpr int width = 900, height = 700;

class Panels : public testing::Test {
 protected:
    Panels()
        : texture_(gpu::Texture::make2D(device_, "window", gpu::Format::rgba8, width, height)),
          target_(device_, "window", &texture_, nullptr) {}

    static bool hasMethod(std::string_view id) {
        return std::ranges::any_of(methods(), [id](const MethodInfo& info) { return info.id == id; });
    }
    /// Opens the viewer at frame 1 of a small state.
    void open(const std::string& a, const std::string& b) {
        ViewState state;
        state.size = {96, 72};
        state.world = {{"particles", "300"}, {"preroll", "0.2"}};
        state.frame = 1;
        state.a.method = a;
        if (!b.empty()) state.b = HalfState{b, {}};
        panels_.reset();  // one canvas at a time
        viewer_ = std::make_unique<Viewer>(state, device_, folder_.path() / "saved");
        viewer_->paused = true;
        viewer_->advance(1e9);
        panels_ = std::make_unique<ViewerPanels>(device_, 13.0f);
        frames(2);
    }
    /// Of the panels; the viewer's picture stays as it is.
    void frames(int count) {
        for (int n = 0; n < count; ++n) {
            panels_->draw(*viewer_, target_, width, height, input_);
            input_.text.clear();
            input_.wheel = 0;
        }
    }
    [[nodiscard]] PanelRectangle at(const std::string& widget) const {
        const auto found = panels_->widgets().all().find(widget);
        if (found == panels_->widgets().all().end()) {
            ADD_FAILURE() << "no widget '" << widget << "'";
            return {};
        }
        return found->second;
    }
    void clickAt(glm::vec2 place) {
        input_.mouse = place;
        frames(2);
        input_.buttons[0] = true;
        frames(2);
        input_.buttons[0] = false;
        frames(2);
    }
    void click(const std::string& widget) { clickAt(at(widget).centre()); }
    /// A slider's edge, from its middle: 0 left, 1 right.
    void slide(const std::string& widget, float share) {
        const PanelRectangle place = at(widget);
        input_.mouse = place.centre();
        frames(2);
        input_.buttons[0] = true;
        frames(1);
        input_.mouse.x = glm::mix(place.minimum.x, place.maximum.x, share);
        frames(2);
        input_.buttons[0] = false;
        frames(2);
    }
    [[nodiscard]] pictures::Image picture() const { return draw::readBack(texture_); }

    gpu::Device device_;
    gpu::Texture texture_;
    gpu::Framebuffer target_;
    TestFolder folder_;
    std::unique_ptr<Viewer> viewer_;
    std::unique_ptr<ViewerPanels> panels_;
    PanelInput input_;
};

/// Share of the pixels of a rectangle that are bright, as text is.
double brightShare(const pictures::Image& image, int left, int right) {
    double bright = 0, all = 0;
    for (int y = 0; y < image.height; ++y)
        for (int x = left; x < right; ++x, ++all) bright += image.at(x, y).g > 0.6f;
    return bright / all;
}

TEST_F(Panels, AreNotEmptyAndHide) {
    open(methods().front().id, methods().back().id);
    const double shown = brightShare(picture(), 0, 300);
    EXPECT_GT(shown, 0.02);
    EXPECT_LT(shown, 0.4);
    for (const char* widget : {"A", "B", "wipe", "Go on", "Restart", "camera", "Copy command", "world/particles"})
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
        const World plain("plain", "", ParameterValues(worldParameters()), 1);
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
    click("Go on");
    EXPECT_FALSE(viewer_->paused);
    click("Pause");
    EXPECT_TRUE(viewer_->paused);
    const std::int64_t frame = viewer_->session().frame();
    click("Step");
    EXPECT_EQ(viewer_->session().frame(), frame + 1);
    click("difference");
    EXPECT_EQ(viewer_->split.shown, Shown::difference);
    click("only B");
    EXPECT_EQ(viewer_->split.shown, Shown::b);
    click("wipe");
    slide("divider", 1);
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

TEST_F(Panels, TheExactPictureIsChosenFromTheListAndHasItsNumbers) {
    open(methods().front().id, "");
    click("B");
    click("B/exact");
    ASSERT_EQ(viewer_->state().b, (HalfState{exactPicture, {}})) << viewer_->message();
    EXPECT_EQ(viewer_->split.shown, Shown::wipe);
    for (int n = 0; n < 2; ++n) viewer_->advance();
    frames(2);
    ASSERT_TRUE(viewer_->session().isCurrent(Half::b));
    click("exact every frame");
    EXPECT_TRUE(viewer_->exactEveryFrame);
    for (const char* view : {"side by side", "FLIP", "difference", "only B", "wipe"}) {
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
        click("channel");
        click("channel/" + std::string(word));
        EXPECT_EQ(viewer_->split.channel, channel);
        viewer_->advance();
        frames(2);
    }
    slide("exposure", 1);
    EXPECT_GT(viewer_->split.stops, 7);
    slide("zoom", 1);
    EXPECT_LT(viewer_->split.extent.x, 0.2f);
    EXPECT_GT(viewer_->split.origin.x, 0.3f);
}

/// Pixels of a rectangle that have this colour.
int countOf(const pictures::Image& image, const PanelRectangle& where, glm::ivec3 colour) {
    int count = 0;
    for (int y = static_cast<int>(where.minimum.y); y < static_cast<int>(where.maximum.y); ++y)
        for (int x = static_cast<int>(where.minimum.x); x < static_cast<int>(where.maximum.x); ++x)
            count += glm::ivec3(glm::round(255.0f * glm::vec3(image.at(x, y)))) == colour;
    return count;
}

TEST_F(Panels, CostsAreStackedByStageAndMemoryByStructure) {
    open(methods().front().id, methods().front().id);
    for (std::size_t n = 0; n < Viewer::keptFrames; ++n) viewer_->advance();
    frames(2);
    const PanelRectangle costs = at("Costs");
    const PanelRectangle below{{0, costs.maximum.y}, {290, at("Memory").minimum.y}};
    const glm::ivec3 scene(86, 180, 233), draw(213, 94, 0);
    for (const glm::ivec3& colour : {scene, draw}) EXPECT_GT(countOf(picture(), below, colour), 400);
    click("Costs");
    EXPECT_LT(at("Memory").minimum.y, costs.maximum.y + 30);
    const float before = at("Parameters of A").minimum.y;
    click("Memory");
    EXPECT_GT(at("Parameters of A").minimum.y, before + 60);
}

TEST_F(Panels, SpeedAndDrawingAreAtHand) {
    open(methods().front().id, "");
    click("speed");
    click("speed/1/4");
    EXPECT_EQ(viewer_->slowness, 4);
    click("draw");
    EXPECT_TRUE(viewer_->drawingPaused);
    click("draw");
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

TEST_F(Panels, KeysWalkThroughThePanelOnlyWhenAsked) {
    open(methods().front().id, "");
    const auto tap = [&](Key key) {
        for (const bool down : {true, false}) {
            input_.keys[static_cast<std::size_t>(key)] = down;
            frames(2);
        }
    };
    click("Go on");
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

TEST_F(Panels, RandomInputDoesNotBreakThem) {
    open(methods().front().id, methods().back().id);
    std::mt19937 random(17);
    const auto below = [&](int limit) { return static_cast<int>(random() % static_cast<unsigned>(limit)); };
    for (int n = 0; n < 400; ++n) {
        input_.mouse = {below(width), below(280)};  // above the parameters, which can ask for ten million particles
        for (bool& button : input_.buttons) button = below(3) == 0;
        input_.wheel = static_cast<float>(below(5) - 2);
        const Key key = static_cast<Key>(below(static_cast<int>(keyCount)));
        input_.keys[static_cast<std::size_t>(key)] = below(2) == 0;
        if (below(4) == 0) input_.text = "1x.";
        if (key != Key::q) below(2) == 0 ? viewer_->press(key, below(4) == 0) : viewer_->release(key);
        frames(1);
        if (n % 8 == 0) viewer_->advance(0.01);
        ASSERT_FALSE(viewer_->wantsToQuit());
    }
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

}  // namespace
}  // namespace dustbench::bench
