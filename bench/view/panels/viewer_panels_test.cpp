// Scripted input on a surfaceless context: widgets are found by name, pictures are read from the framebuffer.
#include "bench/view/panels/viewer_panels.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "bench/scene/world.h"
#include "bench/view/panels/panel_picture.h"
#include "bench/view/panels/panels_fixture.h"
#include "methods/contract/registry.h"

namespace dustbench::bench {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

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

}  // namespace
}  // namespace dustbench::bench
