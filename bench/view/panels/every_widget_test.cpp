// Every method next to every kind of partner, every slider at both ends, every button; windows that change while they
// are drawn.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <random>

#include "bench/view/panels/panel_canvas.h"
#include "bench/view/panels/panels_fixture.h"
#include "bench/world/world.h"
#include "methods/kit/files/data_folder.h"

namespace dustbench::view {
namespace {

using ::testing::HasSubstr;

/// A delivered scene that the method takes.
std::string sceneOf(const MethodInfo& method) {
    std::vector<std::string> scenes = files::listData("scenes", ".toml");
    scenes.insert(scenes.begin(), ViewState().scene);
    for (const std::string& scene : scenes) {
        const world::World world(scene, "", ParameterValues(world::worldParameters()), 1);
        if (!method.cannotTake || method.cannotTake(world.scene()).empty()) return scene;
    }
    return "";
}

class EveryWidget : public Panels {
 protected:
    void openIn(const std::string& scene, const std::string& a, const std::string& b) {
        open(methods().front().id, "");
        ViewState state = viewer_->state();
        state.scene = scene;
        state.frame = 1;
        state.a.method = a;
        state.b = b.empty() ? std::optional<HalfState>() : HalfState{b, {}};
        viewer_->apply(state);
        ASSERT_EQ(viewer_->message(), "") << a << " beside " << b;
        for (int n = 0; n < 3; ++n) viewer_->advance(1e9);
        ASSERT_EQ(viewer_->message(), "") << a << " beside " << b;
        frames(2);
    }
};

TEST_F(EveryWidget, EveryMethodStandsBesideTheExactPictureAndBesideAnother) {
    const std::string partner = hasMethod("billboard") ? "billboard" : methods().front().id;
    for (const MethodInfo& method : methods()) {
        const std::string scene = sceneOf(method);
        ASSERT_NE(scene, "") << method.id;
        for (const std::string& b : {std::string(exactPicture), partner}) {
            openIn(scene, method.id, b);
            if (HasFatalFailure()) return;
            ASSERT_TRUE(viewer_->session().isCurrent(Half::b)) << method.id << " beside " << b;
            EXPECT_THAT(viewer_->stamp(), HasSubstr("A " + method.id));
            for (const auto& [word, shown] : shownChoices.all()) {
                viewer_->split.shown = shown;
                viewer_->advance();
                frames(1);
                EXPECT_EQ(viewer_->message(), "") << method.id << " beside " << b << ": " << word;
            }
            EXPECT_TRUE(viewer_->maps().flipMean()) << method.id << " beside " << b;
            const bool isEvaluated = b == exactPicture && viewer_->session().isEvaluated() &&
                                     viewer_->session().exact().whyNotEvaluated().empty();
            if (isEvaluated) {
                EXPECT_TRUE(viewer_->session().exact().evaluated().metrics.values.of("flip")) << method.id;
            }
        }
    }
}

TEST_F(EveryWidget, EverySliderGoesToBothEnds) {
    open(methods().front().id, methods().front().id);
    const auto value = [&](const std::string& slider) {
        const SplitSettings& split = viewer_->split;
        if (slider == "Exposure") return split.stops;
        if (slider == "Zoom") return 1 / split.extent.x;
        return slider == "Gain" ? split.gain : split.divider;
    };
    struct Slider {
        const char *view, *name;
        float minimum, maximum;
    };
    for (const Slider& slider : {Slider{"Wipe", "Exposure", -8, 8}, Slider{"Wipe", "Divider", 0, 1},
                                 Slider{"Difference", "Gain", 1, 64}, Slider{"Wipe", "Zoom", 1, 9}}) {
        click(slider.view);
        slide(slider.name, 1);
        EXPECT_NEAR(value(slider.name), slider.maximum, 0.02f * slider.maximum) << slider.name;
        viewer_->advance();
        slide(slider.name, 0);
        EXPECT_NEAR(value(slider.name), slider.minimum, 0.02f * slider.maximum) << slider.name;
        viewer_->advance();
        EXPECT_EQ(viewer_->message(), "") << slider.name;
    }
}

TEST_F(EveryWidget, EveryRealParameterOfAMethodGoesToBothEnds) {
    int tried = 0;
    for (const MethodInfo& method : methods()) {
        openIn(sceneOf(method), method.id, "");
        for (const Parameter& parameter : method.parameters.all()) {
            const std::string widget = "a/" + parameter.name;
            if (parameter.type != ParameterType::real) continue;
            if (!panels_->widgets().all().contains(widget) || at(widget).maximum.y > height - 40) continue;
            for (const float share : {0.0f, 1.0f}) {
                slide(widget, share);
                const double end = share == 0 ? parameter.minimum : parameter.maximum;
                const results::ParameterTexts set = viewer_->state().a.parameters;
                const auto given = set.find(parameter.name);
                const double now = std::stod(given == set.end() ? parameter.initial : given->second);
                EXPECT_TRUE(std::abs(now - end) <= 0.02 * (parameter.maximum - parameter.minimum) ||
                            !viewer_->message().empty())
                    << method.id << ' ' << parameter.name << " is " << now << " at " << share;
                ++tried;
            }
            click(widget + "/reset");
        }
    }
    EXPECT_GT(tried, 10);
}

TEST_F(EveryWidget, EveryButtonActs) {
    open(hasMethod("octree_search") ? "octree_search" : methods().front().id, "");
    click("Step");
    const std::int64_t frame = viewer_->session().frame();
    EXPECT_EQ(frame, 2);
    click("Restart");
    EXPECT_LT(viewer_->session().frame(), 0);
    viewer_->advance(1e9);
    click("Save volume");
    EXPECT_NE(viewer_->message(), "");
    click("Measure");
    viewer_->advance();
    EXPECT_THAT(viewer_->message(), HasSubstr("cannot start runs"));  // nothing was given to start them
    click("Draw less to keep 15 fps");
    EXPECT_TRUE(viewer_->keepsPace);
    click("Draw less to keep 15 fps");
    EXPECT_FALSE(viewer_->keepsPace);
    click("Help");
    frames(2);
    EXPECT_TRUE(panels_->widgets().all().contains("Text size"));
}

TEST_F(EveryWidget, TheTextGrowsAsChosenAndBack) {
    open(methods().front().id, "");
    const pictures::Image before = picture();
    const float small = at("A").maximum.y - at("A").minimum.y;
    click("Help");
    click("Text size");
    click("Text size/200 %");
    EXPECT_EQ(panels_->textScale(), 2);
    frames(2);
    EXPECT_NEAR(at("A").maximum.y - at("A").minimum.y, 2 * small, 2);
    panels_->setTextScale(1);
    viewer_->showsHelp = false;
    input_.mouse = glm::vec2(-1);
    frames(3);
    EXPECT_EQ(picture().pixels, before.pixels);
}

TEST_F(EveryWidget, AWindowMayHaveNoAreaAndChangeWhileItDraws) {
    open(methods().front().id, methods().back().id);
    PanelTarget target(device_);
    EXPECT_FALSE(target.fit(0, 0));  // minimised before the first frame
    std::mt19937 random(12);
    for (int n = 0; n < 40; ++n) {
        const int columns = n % 5 == 0 ? 0 : 1 + static_cast<int>(random() % 900);
        const int rows = n % 7 == 0 ? 0 : 1 + static_cast<int>(random() % 700);
        ViewState state = viewer_->state();  // the pictures change their size too
        state.size = {1 + static_cast<int>(random() % 90), 1 + static_cast<int>(random() % 70)};
        if (n % 3 == 0) viewer_->apply(state);
        viewer_->paused = n % 2 == 0;
        viewer_->advance();
        ASSERT_EQ(viewer_->message(), "");
        if (!target.fit(columns, rows)) {
            EXPECT_TRUE(columns == 0 || rows == 0);
            continue;
        }
        input_.mouse = glm::vec2(static_cast<float>(columns) / 2, static_cast<float>(rows) / 2);
        panels_->draw(*viewer_, target.framebuffer(), columns, rows, input_);
        EXPECT_EQ(target.texture().width(), columns);
        EXPECT_EQ(target.texture().height(), rows);
    }
}

}  // namespace
}  // namespace dustbench::view
