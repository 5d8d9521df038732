// The flaw metrics in cases whose value can be computed by hand.
#include "bench/measure/image/flaw_metrics.h"

#include <gtest/gtest.h>

#include <cmath>

#include "bench/measure/image/popping.h"
#include "bench/measure/image/test_images.h"
#include "bench/measure/image/test_splatter.h"
#include "bench/measure/image/volume_error.h"

namespace dustbench::measure {
namespace {

Plane even(int width, int height, double value) {
    return planeOf(width, height, [=](int, int) { return value; });
}

/// A picture with uniform encoded brightness.
Picture greyPicture(float encoded) {
    return pictureOf(20, 10, [=](int, int, int) { return maths::decodeSrgb(encoded); });
}

TEST(FlawMetrics, AreEmptyWhereNoDustIsInView) {
    const Plane none(20, 10), faint = even(20, 10, 0.005);
    const Picture picture = greyPicture(0.5f);
    EXPECT_FALSE(popping({picture, picture, none, faint}, {picture, picture, faint, none}).value);
    EXPECT_FALSE(gaps(none, faint).value);
    EXPECT_FALSE(spill(none, faint).value);
    EXPECT_FALSE(components(none, faint).parts);
    EXPECT_FALSE(components(none, faint).referenceParts);
    EXPECT_FALSE(cutoff(none, none, faint, faint).value);
    EXPECT_FALSE(selfSimilarity(none, faint, {}, 1).value);
    EXPECT_FALSE(quadsPerPixel(100, faint));
    const std::vector<float> nothing(8, 0.0f), something(8, 1.0f);
    EXPECT_FALSE(volumeError({{2, 2, 2}, nothing}, {{2, 2, 2}, something}).value);
}

TEST(Popping, IsTheJumpThatTheReferenceHasNot) {
    // The method's picture jumps by 0.3, the reference's by 0.1; dust covers part of the picture.
    const Plane dust = planeOf(20, 10, [](int x, int) { return x < 5 ? 0.5 : 0.0; }), none(20, 10);
    const Picture a = greyPicture(0.4f), b = greyPicture(0.7f), c = greyPicture(0.5f);
    const Measured jump = popping({a, a, dust, dust}, {b, c, dust, dust});
    EXPECT_NEAR(*jump.value, 0.2, 1e-6);
    EXPECT_NEAR(jump.map.at(4, 3), 0.2, 1e-6);
    EXPECT_EQ(jump.map.at(5, 3), 0);
    // Dust in one of the four alphas is enough.
    EXPECT_NEAR(*popping({a, a, none, none}, {b, c, none, dust}).value, 0.2, 1e-6);
    // A change that both share is motion, not popping.
    EXPECT_EQ(popping({a, a, dust, dust}, {b, b, dust, dust}).value, 0);
}

TEST(Popping, NeedsThirtyPairsInARow) {
    PoppingSummary summary;
    for (int pair = 0; pair < 29; ++pair) summary.add(1.0);
    EXPECT_FALSE(summary.mean());
    EXPECT_FALSE(summary.maximum());
    summary.add(4.0);
    EXPECT_NEAR(*summary.mean(), 33.0 / 30, 1e-12);
    EXPECT_EQ(summary.maximum(), 4);
    // A break; the next stretch counts once it is long enough.
    summary.add({});
    for (int pair = 0; pair < 29; ++pair) summary.add(9.0);
    EXPECT_EQ(summary.maximum(), 4);
    summary.add(9.0);
    EXPECT_NEAR(*summary.mean(), (33.0 + 270) / 60, 1e-12);
    EXPECT_EQ(summary.maximum(), 9);

    PoppingSummary broken;
    for (int pair = 0; pair < 58; ++pair) {
        if (pair == 29) broken.endStretch();
        broken.add(1.0);
    }
    EXPECT_FALSE(broken.mean());
}

TEST(Gaps, AreTheShareOfTheTrailThatIsMissing) {
    const Plane trail = planeOf(20, 10, [](int x, int) { return x < 16 ? 0.4 : 0.1; });
    const Plane half = planeOf(20, 10, [](int x, int) { return x < 4 ? 0.1999 : x < 8 ? 0.2001 : 0.9; });
    const Measured missing = gaps(half, trail);
    EXPECT_EQ(missing.value, 0.25);
    EXPECT_EQ(missing.map.at(3, 9), 1);
    EXPECT_EQ(missing.map.at(4, 9), 0);
    EXPECT_EQ(gaps(trail, trail).value, 0);
    EXPECT_EQ(gaps(Plane(20, 10), trail).value, 1);
}

TEST(Spill, IsTheShareOfTheShownTrailThatIsNotThere) {
    // Shown: α > 0.1 in 16 of 20 columns. Spilt: α > 2R, in the first 4.
    const Plane shown = planeOf(20, 10, [](int x, int) { return x < 16 ? 0.4 : 0.1; });
    const Plane trail = planeOf(20, 10, [](int x, int) { return x < 4 ? 0.1999 : x < 8 ? 0.2001 : x < 16 ? 0.9 : 0; });
    const Measured spilt = spill(shown, trail);
    EXPECT_EQ(spilt.value, 0.25);
    EXPECT_EQ(spilt.map.at(3, 9), 1);
    EXPECT_EQ(spilt.map.at(4, 9), 0);
    EXPECT_EQ(spilt.map.at(17, 9), 0);
    EXPECT_EQ(spill(trail, trail).value, 0);
    EXPECT_FALSE(spill(Plane(20, 10), trail).value);
    EXPECT_EQ(spill(shown, Plane(20, 10)).value, 1);
}

TEST(Spill, IsWhatABlanketPaysForHavingNoGaps) {
    // A trail of 5 of 20 columns. Dust everywhere covers all of it, and three quarters of that dust are outside it.
    const Plane trail = planeOf(20, 10, [](int x, int) { return x < 5 ? 0.8 : 0.0; });
    const Plane blanket = even(20, 10, 0.8), narrow = planeOf(20, 10, [](int x, int) { return x < 2 ? 0.8 : 0.0; });
    EXPECT_EQ(gaps(blanket, trail).value, 0);
    EXPECT_EQ(spill(blanket, trail).value, 0.75);
    EXPECT_EQ(gaps(narrow, trail).value, 0.6);
    EXPECT_EQ(spill(narrow, trail).value, 0);
    // Exchanging the pictures exchanges gaps and spill.
    EXPECT_EQ(spill(trail, blanket).value, gaps(blanket, trail).value);
}

TEST(PoppingSizes, AreThePartsOfPopping) {
    // The left half shows a small primitive and jumps by 0.1, the right half a large one and jumps by 0.3.
    const Plane dust = even(20, 10, 0.5);
    const Picture before = greyPicture(0.4f), still = greyPicture(0.4f);
    const Picture after = pictureOf(20, 10, [](int x, int, int) { return maths::decodeSrgb(x < 10 ? 0.5f : 0.7f); });
    const std::vector<SizedPrimitive> primitives{{{5, 5, 8}, 0.5, 1}, {{15, 5, 8}, 4, 1}};
    const auto sizes = largeAmong(primitives, 20, 10);
    ASSERT_TRUE(sizes);
    const DustFrame from{before, still, dust, dust}, to{after, still, dust, dust};
    const PoppingBySize found = poppingBySize(from, to, *sizes, *sizes);
    EXPECT_NEAR(*found.small, 0.1, 1e-6);
    EXPECT_NEAR(*found.large, 0.3, 1e-6);
    // Half of the pixels each: the squares of the parts add up to that of popping.
    EXPECT_NEAR(*found.smallPart, 0.1 / std::sqrt(2), 1e-6);
    EXPECT_NEAR(*found.largePart, 0.3 / std::sqrt(2), 1e-6);
    const double whole = *popping(from, to).value;
    EXPECT_NEAR(*found.smallPart * *found.smallPart + *found.largePart * *found.largePart, whole * whole, 1e-6);
}

TEST(PoppingSizes, WeighAPixelByTheDepthOfItsPrimitives) {
    // Two primitives in one place: the pixel belongs to the one with more depth. Pixels without primitives belong to
    // none.
    const auto at = [](double smallDepth, double largeDepth) {
        return largeAmong(std::vector<SizedPrimitive>{{{10, 5, 3}, 0.5, smallDepth}, {{10, 5, 3}, 4, largeDepth}}, 20,
                          10);
    };
    EXPECT_LT(at(1, 0.9)->large.at(10, 5), at(1, 0.9)->small.at(10, 5));
    EXPECT_GT(at(0.9, 1)->large.at(10, 5), at(0.9, 1)->small.at(10, 5));
    EXPECT_EQ(at(1, 1)->large.at(0, 0), 0);
    // Primitives of one size are neither small nor large.
    EXPECT_FALSE(largeAmong(std::vector<SizedPrimitive>{{{10, 5, 3}, 2, 1}, {{5, 5, 3}, 2, 1}}, 20, 10));
    EXPECT_FALSE(largeAmong({}, 20, 10));
}

TEST(Components, CountsPartsThatTouchByEdgesOrCorners) {
    const Plane trail = even(40, 20, 0.5);
    const auto parts = [&](const std::function<bool(int, int)>& covered) {
        return components(planeOf(40, 20, [&](int x, int y) { return covered(x, y) ? 0.5 : 0.0; }), trail).parts;
    };
    EXPECT_EQ(parts([](int, int) { return true; }), 1);
    EXPECT_EQ(parts([](int, int) { return false; }), 0);
    EXPECT_EQ(parts([](int x, int) { return x % 10 < 8; }), 4);
    // Two squares of 5×5 that share a corner, and the same with a pixel between them.
    EXPECT_EQ(parts([](int x, int y) { return x < 10 && y < 10 && x / 5 == y / 5; }), 1);
    EXPECT_EQ(parts([](int x, int y) { return (x < 5 && y < 5) || (x > 5 && x < 11 && y >= 5 && y < 10); }), 2);
    // A ring around a disc.
    EXPECT_EQ(parts([](int x, int y) {
                  const double b = std::hypot(x - 20, y - 10);
                  return b < 4 || (b > 6 && b < 9);
              }),
              2);
    // 15 pixels are a speck, 16 are not.
    EXPECT_EQ(parts([](int x, int y) { return y == 3 && x < 15; }), 0);
    EXPECT_EQ(parts([](int x, int y) { return y == 3 && x < 16; }), 1);
}

TEST(Components, NumbersThePartsAndCountsTheReferencesOwn) {
    const Plane trails = planeOf(40, 20, [](int x, int) { return x < 18 || x > 22 ? 0.5 : 0.0; });
    const TrailParts found = components(planeOf(40, 20, [](int x, int) { return x < 10 ? 0.5 : 0.0; }), trails);
    EXPECT_EQ(found.parts, 1);
    EXPECT_EQ(found.referenceParts, 2);
    EXPECT_EQ(found.map.at(9, 0), 1);
    EXPECT_EQ(found.map.at(10, 0), 0);
}

TEST(Cutoff, OfAHardStepIsItsHeightOverTheRootOfTheRows) {
    // Dust of α = 0.6 everywhere; the method cuts it off from row 12 on, the reference does not. Of the 19 rows that
    // have a lower neighbour, one holds the step: RMS = 0.6·√(1/19).
    const Plane whole = even(30, 20, 0.6);
    const Plane cut = planeOf(30, 20, [](int, int y) { return y < 12 ? 0.6 : 0.0; });
    const Measured edge = cutoff(cut, whole, whole, whole);
    EXPECT_NEAR(*edge.value, 0.6 * std::sqrt(1.0 / 19), 1e-6);
    EXPECT_NEAR(edge.map.at(4, 11), 0.6, 1e-6);
    EXPECT_EQ(edge.map.at(4, 10), 0);
    // An empty border has no effect.
    const auto within = [](int width, const Plane& plane) {
        return planeOf(width, 60, [&](int x, int y) { return x < 30 && y < 20 ? plane.at(x, y) : 0.0f; });
    };
    const auto valueIn = [&](int width) {
        const Plane free = within(width, whole);
        return cutoff(within(width, cut), free, free, free).value;
    };
    EXPECT_EQ(valueIn(40), valueIn(400));
    // An edge that the reference also has does not count.
    EXPECT_EQ(cutoff(cut, whole, cut, whole).value, 0);
}

/// Puffs with one texture, far from each other.
std::vector<TestPuff> grid(double radius, int texture) {
    std::vector<TestPuff> puffs;
    puffs.reserve(12);
    for (int row = 0; row < 3; ++row)
        for (int column = 0; column < 4; ++column)
            puffs.push_back({40.0 + 70 * column, 40.3 + 70 * row, 0, radius, 1, texture});
    return puffs;
}
const TestView gridView{290, 220, {}};

double similarityOf(const std::vector<TestPuff>& drawn, std::uint64_t seed = 1) {
    std::vector<TestPuff> plain = drawn;
    for (TestPuff& puff : plain) puff.texture = -1;
    return selfSimilarity(testAlpha(drawn, gridView), testAlpha(plain, gridView), testPrimitives(drawn), seed)
        .value.value();
}

TEST(SelfSimilarity, IsNearOneForOneTextureAtAnySizeAndPlace) {
    // Shifted frames contain some of the same detail by chance, so they subtract a little.
    EXPECT_NEAR(similarityOf(grid(16, 3)), 1, 0.1);
    std::vector<TestPuff> sizes = grid(16, 3);
    for (std::size_t i = 0; i < sizes.size(); ++i) {
        sizes[i].radius = 10 + static_cast<double>(i);
        sizes[i].x += 0.37 * static_cast<double>(i);
    }
    EXPECT_NEAR(similarityOf(sizes), 1, 0.15);
}

TEST(SelfSimilarity, IsNearZeroForDifferentTextures) {
    std::vector<TestPuff> different = grid(16, 0);
    for (std::size_t i = 0; i < different.size(); ++i) different[i].texture = static_cast<int>(i);
    EXPECT_NEAR(similarityOf(different), 0, 0.1);
    EXPECT_EQ(similarityOf(grid(16, -1)), 0);
}

TEST(SelfSimilarity, DependsOnTheSeedAlone) {
    EXPECT_EQ(similarityOf(grid(16, 3), 5), similarityOf(grid(16, 3), 5));
    EXPECT_NE(similarityOf(grid(16, 3), 5), similarityOf(grid(16, 3), 6));
}

TEST(SelfSimilarity, TakesPuffsThatAreLargeEnoughAndWhollyInView) {
    const Plane alpha = even(290, 220, 0.5), reference = even(290, 220, 0.4);
    std::vector<ScreenPrimitive> primitives(8, {100, 100, 4});
    EXPECT_TRUE(selfSimilarity(alpha, reference, primitives, 1).value);
    primitives.back().radiusPixels = 3.9;
    EXPECT_FALSE(selfSimilarity(alpha, reference, primitives, 1).value);
    primitives.back() = {3, 100, 4};  // reaches to −0.2
    EXPECT_FALSE(selfSimilarity(alpha, reference, primitives, 1).value);
    primitives.back() = {-1e9, std::nan(""), 1e8};
    EXPECT_FALSE(selfSimilarity(alpha, reference, primitives, 1).value);
}

TEST(SelfSimilarity, DrawsLotsAmongMany) {
    // Every third of 6,000 primitives shows the texture: in any fair sample, 1 of 9 pairs is alike.
    const std::vector<TestPuff> puffs = grid(16, 3);
    std::vector<TestPuff> plain = grid(16, -1);
    std::vector<ScreenPrimitive> many;
    for (std::size_t i = 0; i < 6'000; ++i) {
        const TestPuff& puff = puffs[i % 12];
        many.push_back({i % 3 == 0 ? puff.x : 145, i % 3 == 0 ? puff.y : 75.3, 16});
    }
    const double value = selfSimilarity(testAlpha(puffs, gridView), testAlpha(plain, gridView), many, 1).value.value();
    EXPECT_GT(value, 0);
    EXPECT_LT(value, 0.2);
}

TEST(QuadsPerPixel, CountsPixelsOfDust) {
    EXPECT_EQ(quadsPerPixel(300, planeOf(20, 10, [](int x, int) { return x < 5 ? 0.02 : 0.01; })), 6);
    EXPECT_EQ(quadsPerPixel(0, even(20, 10, 0.5)), 0);
}

TEST(QuadsPerPixel, MapsHowManyQuadsCoverAPixel) {
    std::vector<ScreenPrimitive> primitives;
    for (std::uint64_t i = 0; i < 50; ++i) {
        const auto [x, y] = testUniform(5, i);
        primitives.push_back({70 * x - 15, 60 * y - 15, 1 + 0.2 * static_cast<double>(i)});
    }
    const Plane map = overdrawMap(primitives, 40, 30);
    for (int y = 0; y < 30; ++y)
        for (int x = 0; x < 40; ++x) {
            int covering = 0;
            for (const ScreenPrimitive& p : primitives) {
                const double half = 1.5 * p.radiusPixels;
                covering += x + 0.5 >= p.xPixels - half && x + 0.5 < p.xPixels + half && y + 0.5 >= p.yPixels - half &&
                            y + 0.5 < p.yPixels + half;
            }
            ASSERT_EQ(map.at(x, y), covering) << x << " " << y;
        }
}

TEST(VolumeError, MeetsItsClosedForms) {
    std::vector<float> b, twice, moved;
    for (int i = 0; i < 24; ++i) b.push_back(static_cast<float>(i % 7));
    for (const float value : b) twice.push_back(2 * value);
    moved = b;
    moved[0] += 5;  // the column x = 0, z = 0
    const std::array cells{4, 3, 2};
    const auto error = [&](const std::vector<float>& grid) { return volumeError({cells, b}, {cells, grid}); };
    EXPECT_EQ(error(b).value, 0);
    EXPECT_NEAR(*error(twice).value, 1, 1e-12);
    EXPECT_NEAR(*error(std::vector<float>(24, 0.0f)).value, 1, 1e-12);
    double squares = 0;
    for (const float value : b) squares += static_cast<double>(value) * static_cast<double>(value);
    EXPECT_NEAR(*error(moved).value, 5 / std::sqrt(squares), 1e-12);
    EXPECT_NEAR(error(moved).map.at(0, 0), 5 / std::sqrt(squares), 1e-6);
    double map = 0;
    for (const float value : error(twice).map.values) map += static_cast<double>(value) * static_cast<double>(value);
    EXPECT_NEAR(map, 1, 1e-6);
}

}  // namespace
}  // namespace dustbench::measure
