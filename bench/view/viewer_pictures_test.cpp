// Views of the viewer: side by side, FLIP, overdraw, faults; zoom and the value under the cursor.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <random>

#include "bench/measure/image/flaw_metrics.h"
#include "bench/measure/image/heat_map.h"
#include "bench/measure/image/picture_error.h"
#include "bench/reference/judge/moment_pictures.h"
#include "bench/view/viewer.h"
#include "methods/contract/registry.h"
#include "methods/kit/draw/read_back.h"
#include "methods/kit/testing/test_folder.h"

namespace dustbench::view {
namespace {

using ::testing::HasSubstr;

constexpr float nearColour = 0.51f / 255;

class ViewerPictures : public testing::Test {
 protected:
    static bool hasMethod(std::string_view id) {
        return std::ranges::any_of(methods(), [id](const MethodInfo& info) { return info.id == id; });
    }
    /// Paused at frame 2.
    void open(const std::string& a, const std::string& b) {
        ViewState state;
        state.size = {64, 48};
        state.world = {{"particles", "300"}, {"preroll", "0.3"}};
        state.frame = 2;
        state.a.method = a;
        if (!b.empty()) state.b = HalfState{b, {}};
        viewer_ = std::make_unique<Viewer>(state, device_, folder_.path());
        viewer_->paused = true;
        viewer_->advance(1e9);
    }
    [[nodiscard]] pictures::Image shown() const { return draw::readBack(viewer_->image()); }
    [[nodiscard]] pictures::Image pictureOf(Half half) const {
        return draw::readBack(viewer_->session().picture(half));
    }

    gpu::Device device_;
    TestFolder folder_;
    std::unique_ptr<Viewer> viewer_;
};

TEST_F(ViewerPictures, SideBySideIsTwiceAsWideAndSaved) {
    open(methods().front().id, methods().back().id);
    viewer_->split.shown = Shown::sideBySide;
    viewer_->advance();
    const pictures::Image image = shown(), a = pictureOf(Half::a), b = pictureOf(Half::b);
    ASSERT_EQ(image.width, 128);
    ASSERT_EQ(image.height, 48);
    for (int y = 0; y < 48; ++y)
        for (int x = 0; x < 64; ++x) {
            ASSERT_EQ(image.at(x, y), a.at(x, y));
            ASSERT_EQ(image.at(64 + x, y), b.at(x, y));
        }
    viewer_->press(Key::p, false);
    EXPECT_EQ(pictures::readImage(folder_.path() / "f000002.png").width, 128);
    viewer_->split.shown = Shown::wipe;
    viewer_->advance();
    EXPECT_EQ(viewer_->image().width(), 64);
}

TEST_F(ViewerPictures, FlipIsThatOfTheMetric) {
    open(methods().front().id, methods().front().id);
    viewer_->split.shown = Shown::flip;
    viewer_->advance();
    EXPECT_EQ(viewer_->maps().flipMean(), 0.0);
    for (const glm::vec4& pixel : shown().pixels)
        ASSERT_NEAR(pixel.r, pictures::encodeSrgb(measure::heatColour(0).r), nearColour);
    if (!hasMethod("billboard") || !hasMethod("octree_search")) GTEST_SKIP() << "one of the methods is missing";
    open("billboard", "octree_search");
    viewer_->split.shown = Shown::flip;
    viewer_->advance();
    const measure::Measured expected = measure::flip(measure::preparePicture(viewer_->session().image(Half::b), "b"),
                                                     measure::preparePicture(viewer_->session().image(Half::a), "a"));
    ASSERT_TRUE(viewer_->maps().flipMean());
    EXPECT_EQ(*viewer_->maps().flipMean(), *expected.value);
    EXPECT_GT(*expected.value, 1e-3);
    const pictures::Image colours = measure::heatMap(expected.map), image = shown();
    for (std::size_t i = 0; i < image.pixels.size(); ++i)
        for (int channel = 0; channel < 3; ++channel)
            ASSERT_NEAR(image.pixels[i][channel], pictures::encodeSrgb(colours.pixels[i][channel]), nearColour);
    EXPECT_THAT(viewer_->stamp(), HasSubstr("frame 2: FLIP of A billboard with reference B octree_search"));
    const pictures::Image before = shown();
    viewer_->press(Key::period, false);
    viewer_->advance();
    EXPECT_NE(shown().pixels, before.pixels);
    EXPECT_THAT(viewer_->stamp(), HasSubstr("frame 3: FLIP"));
}

TEST_F(ViewerPictures, OverdrawCountsThePrimitivesOverEachPixel) {
    if (!hasMethod("billboard")) GTEST_SKIP() << "no billboards here";
    open("billboard", "");
    viewer_->split.channel = Channel::overdraw;
    viewer_->advance();
    exports::CollectedVolume dust;
    dust.puffs(viewer_->session().world().dust());
    const measure::Plane map =
        measure::overdrawMap(reference::primitivesOnScreen(dust, viewer_->session().view()), 64, 48);
    const float maximum = std::ranges::max(map.values);
    ASSERT_GT(maximum, 3);
    EXPECT_EQ(viewer_->maps().overdrawLimit(), static_cast<double>(maximum));
    const pictures::Image image = shown();
    for (int y = 0; y < 48; ++y)
        for (int x = 0; x < 64; ++x)
            ASSERT_NEAR(image.at(x, y).g, pictures::encodeSrgb(measure::heatColour(map.at(x, y) / maximum).g),
                        nearColour);
}

TEST_F(ViewerPictures, FaultsAreCountedWithTheFirst) {
    pictures::Image layer{4, 3, std::vector<glm::vec4>(12, glm::vec4(0.5f))};
    EXPECT_EQ(faultsOf(layer).first, std::nullopt);
    layer.pixels[6].b = std::numeric_limits<float>::quiet_NaN();
    layer.pixels[7].r = -0.1f;
    layer.pixels[9].a = 1.1f;
    layer.pixels[10].a = 1.0005f;  // within rounding
    const LayerFaults faults = faultsOf(layer);
    EXPECT_EQ(faults.notFinite, 1);
    EXPECT_EQ(faults.negative, 1);
    EXPECT_EQ(faults.alpha, 1);
    EXPECT_EQ(faults.first, glm::ivec2(2, 1));
    open(methods().front().id, methods().back().id);
    for (const Half half : {Half::a, Half::b}) EXPECT_EQ(viewer_->faults(half).first, std::nullopt);
}

TEST_F(ViewerPictures, TheValueUnderTheCursorIsThatOfThePictureThere) {
    open(methods().front().id, methods().back().id);
    std::mt19937 random(11);
    std::uniform_real_distribution<float> share(0, 1);
    for (const Shown view : {Shown::a, Shown::b, Shown::wipe, Shown::sideBySide}) {
        viewer_->split = {};
        viewer_->split.shown = view;
        for (int n = 0; n < 12; ++n) {
            if (n == 6) viewer_->zoom({0.7f, 0.6f}, 3);
            viewer_->advance();
            const pictures::Image image = shown();
            const int x = static_cast<int>(share(random) * static_cast<float>(image.width));
            const int y = static_cast<int>(share(random) * static_cast<float>(image.height));
            if (view == Shown::wipe && std::abs(x - image.width / 2) < 2) continue;  // the divider
            const glm::vec2 place((static_cast<float>(x) + 0.5f) / static_cast<float>(image.width),
                                  (static_cast<float>(y) + 0.5f) / static_cast<float>(image.height));
            const PixelValue value = viewer_->valueAt(place);
            ASSERT_EQ(value.display, glm::vec3(image.at(x, y))) << shownChoices.wordOf(view) << ' ' << x << ' ' << y;
            const pictures::Image light = viewer_->session().image(value.half);
            for (int channel = 0; channel < 3; ++channel)
                ASSERT_NEAR(value.light[channel], light.at(value.x, value.y)[channel], 1e-5f);
            EXPECT_EQ(glm::vec3(pictureOf(value.half).at(value.x, value.y)), value.display);
        }
    }
}

TEST_F(ViewerPictures, ZoomKeepsThePlaceUnderTheCursorAndEndsAtTheWhole) {
    open(methods().front().id, "");
    const auto texelAt = [&](glm::vec2 place) {
        return viewer_->split.origin + viewer_->split.extent * glm::vec2(place.x, 1 - place.y);
    };
    const glm::vec2 place(0.3f, 0.8f);
    const glm::vec2 before = texelAt(place);
    viewer_->zoom(place, 2);
    EXPECT_EQ(viewer_->split.extent, glm::vec2(0.5f));
    EXPECT_LT(glm::distance(texelAt(place), before), 1e-6f);
    viewer_->pan({0.1f, 0.2f});
    EXPECT_LT(glm::distance(texelAt(place), before + glm::vec2(-0.05f, 0.1f)), 1e-6f);
    viewer_->zoom(place, 1e9);
    EXPECT_FLOAT_EQ(viewer_->split.extent.x * 48, 8);
    viewer_->advance();
    viewer_->pan({-1e3f, 1e3f});
    EXPECT_GE(viewer_->split.origin.x, 0);
    EXPECT_LE(viewer_->split.origin.x + viewer_->split.extent.x, 1.0001f);
    viewer_->zoom(place, 1e-9);
    EXPECT_EQ(viewer_->split.extent, glm::vec2(1));
    EXPECT_EQ(viewer_->split.origin, glm::vec2(0));
    viewer_->zoom(place, 4);
    viewer_->press(Key::z, false);
    EXPECT_EQ(viewer_->split.extent, glm::vec2(1));
}

TEST_F(ViewerPictures, KeysGoThroughAllViewsAndChannels) {
    open(methods().front().id, methods().back().id);
    std::vector<Shown> views;
    std::vector<Channel> channels;
    for (std::size_t n = 0; n < shownChoices.all().size(); ++n) {
        viewer_->press(Key::v, false);
        views.push_back(viewer_->split.shown);
        for (std::size_t k = 0; k < channelChoices.all().size(); ++k) {
            viewer_->press(Key::n, false);
            if (n == 0) channels.push_back(viewer_->split.channel);
            viewer_->advance();
            ASSERT_EQ(viewer_->message(), "");
        }
    }
    EXPECT_EQ(viewer_->split.shown, Shown::wipe);
    EXPECT_EQ(viewer_->split.channel, Channel::picture);
    for (const auto& [word, value] : shownChoices.all()) EXPECT_EQ(std::ranges::count(views, value), 1) << word;
    for (const auto& [word, value] : channelChoices.all()) EXPECT_EQ(std::ranges::count(channels, value), 1) << word;
}

}  // namespace
}  // namespace dustbench::view
