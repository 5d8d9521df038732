// Halves drawn smaller to keep the pace, with a size that the test sets; a context that is lost; files dropped.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <algorithm>
#include <fstream>

#include "bench/view/viewer.h"
#include "methods/contract/registry.h"
#include "methods/kit/draw/read_back.h"
#include "methods/kit/files/limits.h"
#include "methods/kit/testing/test_folder.h"

namespace dustbench::view {
namespace {

using ::testing::HasSubstr;

constexpr results::ImageSize full{80, 60}, lowered{48, 36};

class Paced : public testing::Test {
 protected:
    void open(const std::string& a, const std::string& b) {
        ViewState state;
        state.size = full;
        state.world = {{"particles", "300"}, {"preroll", "0.3"}};
        state.frame = 2;
        state.a.method = a;
        if (!b.empty()) state.b = HalfState{b, {}};
        viewer_ = std::make_unique<Viewer>(state, device_, folder_.path() / "saved");
        viewer_->advance(1e9);
    }
    /// Opens the method as A, and returns an equal viewer; null if the method does not draw this scene.
    std::unique_ptr<Viewer> openTwice(const std::string& a, const std::string& b = "") {
        ViewState state;
        state.size = full;
        state.world = {{"particles", "300"}, {"preroll", "0.3"}};
        state.a.method = a;
        if (!b.empty()) state.b = HalfState{b, {}};
        try {
            viewer_ = std::make_unique<Viewer>(state, device_, folder_.path());
            return std::make_unique<Viewer>(state, device_, folder_.path());
        } catch (const InputError&) {
            return nullptr;
        }
    }
    void lower() {
        viewer_->keepsPace = true;
        viewer_->drawShare = 0.6;
    }
    [[nodiscard]] results::ImageSize drawn() const { return viewer_->session().drawnSize(); }
    [[nodiscard]] pictures::Image shown() const { return draw::readBack(viewer_->image()); }
    [[nodiscard]] std::vector<glm::vec4> shownImage() const { return shown().pixels; }

    /// A lowered picture, bilinear at the centre of pixel (x, y) of the full one.
    static glm::vec4 interpolated(const pictures::Image& small, int x, int y) {
        const glm::vec2 place = (glm::vec2(x, y) + 0.5f) * 0.6f - 0.5f, lower = glm::floor(place);
        const glm::vec2 share = place - lower;
        const auto pixel = [&](float right, float down) {
            const glm::ivec2 at = glm::clamp(glm::ivec2(lower) + glm::ivec2(right, down), glm::ivec2(0),
                                             glm::ivec2(small.width - 1, small.height - 1));
            return small.at(at.x, at.y);
        };
        return glm::mix(glm::mix(pixel(0, 0), pixel(1, 0), share.x), glm::mix(pixel(0, 1), pixel(1, 1), share.x),
                        share.y);
    }

    gpu::Device device_;
    TestFolder folder_;
    std::unique_ptr<Viewer> viewer_;
};

TEST_F(Paced, ALoweredHalfIsScaledUpToTheViewAndSaysSo) {
    open(methods().front().id, methods().back().id);
    EXPECT_EQ(viewer_->drawnRemark(), "");
    lower();
    viewer_->split.shown = Shown::a;
    viewer_->advance();
    EXPECT_EQ(drawn(), lowered);
    EXPECT_EQ(viewer_->drawnRemark(), "drawn at 48x36 of 80x60 to keep 15 frames per second");
    const pictures::Image image = shown(), small = draw::readBack(viewer_->session().picture(Half::a));
    ASSERT_EQ(image.width, full.width);
    ASSERT_EQ(small.width, lowered.width);
    for (int y = 0; y < full.height; ++y)
        for (int x = 0; x < full.width; ++x)
            for (int channel = 0; channel < 3; ++channel)
                ASSERT_NEAR(image.at(x, y)[channel], interpolated(small, x, y)[channel], 1.0f / 255) << x << ' ' << y;
    viewer_->keepsPace = false;
    viewer_->advance();
    EXPECT_EQ(drawn(), full);
    EXPECT_EQ(viewer_->drawnRemark(), "");
}

/// Compares the visible parts, bit by bit, with those of a viewer that draws whole pictures. When the motion stops, the
/// hidden parts are drawn too.
TEST_F(Paced, OnlyWhatIsShownIsDrawnAndIsTheSame) {
    for (const MethodInfo& method : methods()) {
        const std::unique_ptr<Viewer> whole = openTwice(method.id, "billboard");
        if (!whole) {
            EXPECT_EQ(method.id, "relief");
            continue;
        }
        viewer_->keepsPace = viewer_->drawsOnlyShown = true;
        for (int n = 0; n < 3; ++n) viewer_->advance(1e9), whole->advance(1e9);
        for (const auto& [shown, isEnlarged] :
             {std::pair(Shown::wipe, false), std::pair(Shown::b, false), std::pair(Shown::sideBySide, false),
              std::pair(Shown::wipe, true), std::pair(Shown::difference, true), std::pair(Shown::a, false)}) {
            SplitSettings settings;
            settings.shown = shown;
            settings.divider = 0.3f;
            if (isEnlarged) settings.origin = {0.5f, 0.4f}, settings.extent = {0.4f, 0.4f};
            viewer_->split = whole->split = settings;
            viewer_->advance();
            whole->advance();
            EXPECT_EQ(shownImage(), draw::readBack(whole->image()).pixels)
                << method.id << ' ' << shownChoices.wordOf(shown);
            const bool isWhole = shown == Shown::sideBySide;
            EXPECT_EQ(viewer_->drawnRemark(),
                      isWhole ? "" : "drawn only where it is shown to keep 15 frames per second");
        }
        const auto isBlank = [&](Half half) {
            const pictures::Image image = draw::readBack(viewer_->session().picture(half));
            return std::ranges::all_of(image.pixels, [&](const glm::vec4& p) { return p == image.pixels.front(); });
        };
        viewer_->paused = true;
        viewer_->advance();
        EXPECT_EQ(viewer_->drawnRemark(), "") << method.id;
        EXPECT_FALSE(isBlank(Half::b)) << method.id;
    }
}

TEST_F(Paced, WhatIsNotShownIsNotDrawn) {
    open(methods().front().id, "billboard");
    viewer_->keepsPace = viewer_->drawsOnlyShown = true;
    viewer_->split.divider = 0.25f;
    const pictures::Image before = draw::readBack(viewer_->session().picture(Half::a));
    for (int n = 0; n < 10; ++n) viewer_->advance();
    const pictures::Image after = draw::readBack(viewer_->session().picture(Half::a));
    int changedShown = 0, changedHidden = 0;  // up to 16 columns beyond the divider, at 20, may be drawn too
    for (int y = 0; y < full.height; ++y)
        for (int x = 0; x < full.width; ++x)
            if (before.at(x, y) != after.at(x, y)) changedShown += x < 20, changedHidden += x >= 36;
    EXPECT_GT(changedShown, 0);
    EXPECT_EQ(changedHidden, 0);
    viewer_->split.shown = Shown::b;
    viewer_->advance();
    EXPECT_EQ(sum(viewer_->costs().back().halves[0].draw), 0);
    EXPECT_GT(sum(viewer_->costs().back().halves[1].draw), 0);
}

TEST_F(Paced, EveryMethodDrawsTheSamePictureAfterwards) {
    for (const MethodInfo& method : methods()) {
        const std::unique_ptr<Viewer> once = openTwice(method.id);
        if (!once) {
            EXPECT_EQ(method.id, "relief");
            continue;
        }
        lower();
        for (int n = 0; n < 3; ++n) viewer_->advance(1e9), once->advance(1e9);
        EXPECT_EQ(drawn(), lowered) << method.id;
        viewer_->keepsPace = false;
        viewer_->advance();
        once->advance();
        EXPECT_EQ(viewer_->session().frame(), once->session().frame());
        EXPECT_EQ(shown().pixels, draw::readBack(once->image()).pixels) << method.id;
        EXPECT_EQ(viewer_->session().host(Half::a).gpuBytes(), once->session().host(Half::a).gpuBytes()) << method.id;
    }
}

TEST_F(Paced, WhatIsJudgedSavedOrStatedIsOfTheFullSize) {
    open(methods().front().id, methods().back().id);
    const std::string line = viewer_->line(Half::a);
    lower();
    viewer_->paused = true;
    viewer_->press(Key::period, false);
    viewer_->advance();
    EXPECT_EQ(drawn(), lowered);
    viewer_->press(Key::p, false);
    const pictures::Image png = pictures::readImage(folder_.path() / "saved" / "f000003.png");
    const pictures::Image light = pictures::readImage(folder_.path() / "saved" / "f000003.exr");
    Viewer other(viewer_->state(), device_, folder_.path());
    other.paused = true;
    other.advance(1e9);
    other.split.shown = viewer_->split.shown;
    other.advance();
    const pictures::Image expected = draw::readBack(other.image());
    ASSERT_EQ(png.width, full.width);
    ASSERT_EQ(light.width, full.width);
    for (std::size_t i = 0; i < expected.pixels.size(); ++i)
        ASSERT_NEAR(pictures::encodeSrgb(png.pixels[i].g), expected.pixels[i].g, 0.5 / 255);
    EXPECT_EQ(viewer_->state().size, full);
    viewer_->press(Key::b, false);
    for (const auto& [word, shown] : shownChoices.all())
        for (const auto& [name, channel] : channelChoices.all()) {
            viewer_->paused = false;
            viewer_->split.shown = shown;
            viewer_->split.channel = channel;
            viewer_->advance();
            const bool isMap = shown == Shown::flip || channel == Channel::overdraw || channel == Channel::outlines ||
                               channel == Channel::faults;
            EXPECT_EQ(drawn(), isMap ? full : lowered) << word << ' ' << name;
            EXPECT_EQ(viewer_->message().find("differ"), std::string::npos) << viewer_->message();
        }
    EXPECT_THAT(line, HasSubstr("--size 80x60"));
    EXPECT_THAT(viewer_->line(Half::a), HasSubstr("--size 80x60"));
    for (const suite::PlannedRun& run : measurementOf(viewer_->state()).cells) EXPECT_EQ(run.spec.size, full);
}

TEST_F(Paced, TheExactPictureStandsBesideAFullOne) {
    open(methods().front().id, exactPicture);
    lower();
    viewer_->advance();
    EXPECT_EQ(drawn(), lowered);  // A alone
    viewer_->press(Key::e, false);
    for (int n = 0; n < 3; ++n) {
        viewer_->advance();
        EXPECT_EQ(drawn(), full);
        EXPECT_TRUE(viewer_->session().isEvaluated());
        EXPECT_EQ(viewer_->message(), "");
    }
    viewer_->press(Key::space, false);
    viewer_->slowness = 8;
    for (int n = 0; n < 20; ++n) {
        viewer_->advance();
        EXPECT_EQ(viewer_->message(), "");
    }
    viewer_->exactEveryFrame = true;
    for (int n = 0; n < 4; ++n) {
        viewer_->advance();
        EXPECT_EQ(drawn(), full);
        EXPECT_EQ(viewer_->message(), "");
    }
}

TEST_F(Paced, AtRestThePictureIsDrawnOnceAtFullSize) {
    open(methods().front().id, "");
    lower();
    viewer_->advance();
    viewer_->paused = true;
    viewer_->advance();
    EXPECT_EQ(drawn(), full);
    const std::size_t frames = viewer_->costs().size();
    viewer_->advance();
    ASSERT_GT(viewer_->costs().size(), frames);
    EXPECT_EQ(sum(viewer_->costs().back().halves[0].draw), 0);  // it already exists
    viewer_->turnCamera(0.1, 0);
    viewer_->advance();
    EXPECT_EQ(drawn(), lowered);
    viewer_->advance();
    EXPECT_EQ(drawn(), full);
    viewer_->split.stops = 1;  // is seen though nothing moves
    const pictures::Image before = shown();
    viewer_->advance();
    EXPECT_NE(shown().pixels, before.pixels);
    viewer_->paused = false;
    viewer_->drawingPaused = true;
    viewer_->advance();
    viewer_->turnCamera(0.1, 0);
    viewer_->advance();
    EXPECT_EQ(drawn(), full);
}

TEST_F(Paced, OnlyFramesOfTheSizeThatWasAskedForAreCounted) {
    open(methods().front().id, "");
    const auto counted = [&](int frames) {
        int count = 0;
        for (int n = 0; n < frames; ++n) {
            viewer_->advance();
            const auto paced = viewer_->takePaced();
            if (!paced) continue;
            ++count;
            EXPECT_GT(paced->wholeMs, paced->drawMs);
            EXPECT_GT(paced->drawMs, 0);
        }
        return count;
    };
    EXPECT_EQ(counted(4), 0);  // switched off
    viewer_->keepsPace = true;
    EXPECT_EQ(counted(4), 3);  // a frame's time is known when it has ended
    EXPECT_FALSE(viewer_->takePaced());
    lower();
    EXPECT_EQ(counted(4), 3);
    viewer_->split.channel = Channel::faults;
    EXPECT_EQ(counted(4), 1);
    viewer_->split.channel = Channel::picture;
    viewer_->paused = true;
    EXPECT_EQ(counted(4), 0);  // at rest
}

TEST_F(Paced, ALostContextEndsItInOneLine) {
    open(methods().front().id, "");
    int asked = 0;
    viewer_->watchContext([&] { return ++asked > 3; });
    for (int n = 0; n < 3; ++n) viewer_->advance();
    try {
        viewer_->advance();
        FAIL() << "it went on";
    } catch (const InputError& error) {
        EXPECT_THAT(error.what(), HasSubstr("view: the OpenGL context is lost"));
        EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos);
    }
}

TEST_F(Paced, ADroppedFileIsReadWithinTheLimits) {
    open(methods().front().id, "");
    ViewState other = viewer_->state();
    other.seed = 77;
    viewer_->applyFile(folder_.write("state.toml", toToml(other)));
    EXPECT_EQ(viewer_->message(), "");
    EXPECT_EQ(viewer_->state().seed, 77u);
    other.seed = 78;
    viewer_->applyFile(folder_.write("line.txt", commandLine(other, Half::a, "o") + "\n"));
    EXPECT_EQ(viewer_->state().seed, 78u);
    const std::filesystem::path pipe = folder_.path() / "pipe", large = folder_.path() / "large";
    ASSERT_EQ(mkfifo(pipe.c_str(), 0600), 0);
    folder_.write("large", "");
    std::filesystem::resize_file(large, files::limits::textBytes + 1);
    for (const auto& [file, expected] :
         {std::pair(pipe, "is a pipe"), std::pair(folder_.path(), "is a folder"), std::pair(large, "is too large"),
          std::pair(folder_.path() / "none", "No such file")}) {
        viewer_->applyFile(file);
        EXPECT_THAT(viewer_->message(), HasSubstr(file.string() + ": "));
        EXPECT_THAT(viewer_->message(), HasSubstr(expected));
        EXPECT_EQ(viewer_->state().seed, 78u);
    }
}

}  // namespace
}  // namespace dustbench::view
