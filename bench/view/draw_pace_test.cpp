#include "bench/view/draw_pace.h"

#include <gtest/gtest.h>

#include <limits>
#include <random>

namespace dustbench::view {
namespace {

constexpr double limitMs = 1000 / pacedFramesPerSecond;

/// The cost of a frame at a share of the size: T = fixed + perFrame + perPixel·s². The last two are drawing. Of
/// perPixel, visible parts take the share `dust`, though they have the share `shown` of the pixels.
struct Costs {
    double fixed, perFrame, perPixel, shown = 1, dust = shown;
    [[nodiscard]] PacedFrame at(double share, bool onlyShown = false) const {
        const double draw = perFrame + perPixel * share * share * (onlyShown ? dust : 1);
        return {fixed + draw, draw, shown};
    }
};

void note(DrawPace& pace, const Costs& costs, int frames) {
    for (int n = 0; n < frames; ++n) pace.note(costs.at(pace.share(), pace.drawsOnlyShown()));
}

TEST(DrawPace, KeepsTheFullSizeWhereThereIsTime) {
    DrawPace pace;
    note(pace, {5, 5, 0.95 * limitMs - 10}, 1000);
    EXPECT_EQ(pace.share(), 1);
}

TEST(DrawPace, LowersToTheLargestSizeThatKeepsThePace) {
    DrawPace pace;
    note(pace, {10, 0, 100}, static_cast<int>(DrawPace::framesToLower) - 1);
    EXPECT_EQ(pace.share(), 1);  // not yet
    note(pace, {10, 0, 100}, 1);
    EXPECT_EQ(pace.share(), 0.6);  // 10 + 100·0.64 = 74 is too slow, 10 + 100·0.36 = 46 is not
    note(pace, {10, 0, 100}, 1000);
    EXPECT_EQ(pace.share(), 0.6);
}

TEST(DrawPace, DrawsOnlyWhatIsShownBeforeItLowersTheSize) {
    DrawPace pace;
    note(pace, {10, 0, 90, 0.5}, static_cast<int>(DrawPace::framesToLower) - 1);
    EXPECT_FALSE(pace.drawsOnlyShown());
    note(pace, {10, 0, 90, 0.5}, 1000);
    EXPECT_TRUE(pace.drawsOnlyShown());
    EXPECT_EQ(pace.share(), 1);  // 10 + 90·0.5 = 55
    note(pace, {10, 0, 120, 0.5}, 1000);
    EXPECT_EQ(pace.share(), 0.8);  // 10 + 120·0.5 = 70 is too slow, 10 + 60·0.64 = 48 is not
    note(pace, {10, 0, 120, 1}, 1000);
    EXPECT_EQ(pace.share(), 0.6);  // both pictures are seen whole again
    note(pace, {5, 1, 20}, 1000);
    EXPECT_FALSE(pace.drawsOnlyShown());
}

TEST(DrawPace, ASlowFrameNowAndThenChangesNothing) {
    DrawPace pace;
    for (int n = 0; n < 1000; ++n) pace.note(n % 4 == 0 ? PacedFrame{900, 890} : PacedFrame{20, 10});
    EXPECT_EQ(pace.share(), 1);
}

TEST(DrawPace, DrawsAtFullSizeWhenDrawingIsNotWhatIsSlow) {
    DrawPace pace;
    note(pace, {400, 2, 20}, 1000);
    EXPECT_EQ(pace.share(), 1);
}

TEST(DrawPace, IsAsSmallAsItGetsWhereNothingSuffices) {
    DrawPace pace;
    note(pace, {60, 0, 5000}, 1000);
    EXPECT_EQ(pace.share(), DrawPace::shares.back());
}

TEST(DrawPace, GoesBackToTheFullSizeWhenTheLoadIsGone) {
    DrawPace pace;
    note(pace, {10, 0, 1000}, 100);
    EXPECT_EQ(pace.share(), DrawPace::shares.back());
    note(pace, {5, 1, 20}, static_cast<int>(DrawPace::framesToRaise * DrawPace::shares.size()));
    EXPECT_EQ(pace.share(), 1);
}

/// Where visible parts cost much less or more than their pixels, too.
TEST(DrawPace, DoesNotSwingBetweenPartsAndWholePictures) {
    std::mt19937 random(26);
    std::uniform_real_distribution<double> upTo(0, 1);
    for (int trial = 0; trial < 500; ++trial) {
        const Costs costs{40 * upTo(random), 10 * upTo(random), 300 * upTo(random), 0.5, upTo(random)};
        DrawPace pace;
        note(pace, costs, 400);
        int changes = 0;
        // Costs are constant, so after a window of frames without a change none can follow.
        for (std::size_t n = 0; n < 10 * DrawPace::framesToRaise; ++n) {
            const double before = pace.share();
            const bool wereParts = pace.drawsOnlyShown();
            note(pace, costs, 1);
            changes += before != pace.share() || wereParts != pace.drawsOnlyShown();
        }
        EXPECT_EQ(changes, 0) << trial;
    }
}

/// For constant costs the size only gets smaller, and it keeps the pace or is the smallest that helps.
TEST(DrawPace, NeverSwingsBetweenTwoSizes) {
    std::mt19937 random(25);
    std::uniform_real_distribution<double> upTo(0, 1);
    for (int trial = 0; trial < 500; ++trial) {
        const Costs costs{60 * upTo(random), 80 * upTo(random), 600 * upTo(random)};
        DrawPace pace;
        double before = 1;
        for (int n = 0; n < 400; ++n) {
            pace.note(costs.at(pace.share()));
            ASSERT_LE(pace.share(), before) << trial;
            before = pace.share();
        }
        const bool keepsPace = costs.at(before).wholeMs <= limitMs;
        const bool isWorthLess = costs.at(before).drawMs < 0.25 * costs.at(before).wholeMs;
        EXPECT_TRUE(keepsPace || before == DrawPace::shares.back() || isWorthLess) << trial;
    }
}

/// Frame times vary by a sixth in both directions, around a limit that no size clearly meets.
TEST(DrawPace, IsSteadyUnderNoise) {
    for (const unsigned seed : {1u, 2u, 3u}) {
        std::mt19937 random(seed);
        std::uniform_real_distribution<double> factor(0.85, 1.15);
        for (const double perPixel : {60.0, 90.0, 130.0, 250.0, 400.0}) {
            DrawPace pace;
            int changes = 0;
            for (int n = 0; n < 3000; ++n) {
                const double before = pace.share();
                PacedFrame frame = Costs{8, 4, perPixel}.at(before);
                frame.wholeMs *= factor(random);
                frame.drawMs *= factor(random);
                pace.note(frame);
                changes += pace.share() != before;
            }
            EXPECT_LE(changes, 3) << seed << ' ' << perPixel;
        }
    }
}

TEST(DrawPace, IgnoresTimesThatAreNone) {
    DrawPace pace;
    for (const double time :
         {0.0, -5.0, std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()})
        for (int n = 0; n < 50; ++n) pace.note({time, time});
    EXPECT_EQ(pace.share(), 1);
    for (int n = 0; n < 50; ++n) pace.note({200, std::numeric_limits<double>::quiet_NaN()});
    EXPECT_EQ(pace.share(), 1);  // nothing is known to be gained
}

TEST(DrawPace, SharesOfASizeHaveAPixelAtLeast) {
    EXPECT_EQ(shareOf({800, 600}, 0.6), (results::ImageSize{480, 360}));
    EXPECT_EQ(shareOf({2, 1}, 0.2), (results::ImageSize{1, 1}));
}

}  // namespace
}  // namespace dustbench::view
