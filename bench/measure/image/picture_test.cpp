#include "bench/measure/image/picture.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>

#include "bench/measure/image/flaw_metrics.h"
#include "bench/measure/image/picture_error.h"
#include "bench/measure/image/popping.h"
#include "bench/measure/image/test_images.h"
#include "bench/measure/image/volume_error.h"
#include "methods/kit/testing/test_input_error.h"

namespace dustbench::measure {
namespace {

constexpr float nan = std::numeric_limits<float>::quiet_NaN(), inf = std::numeric_limits<float>::infinity();

pictures::Image greyImage(int width, int height) {
    return imageOf(width, height, [](int, int, int) { return 0.5; });
}

TEST(ImageCheck, CountsAndNamesPixelsThatAreNotFinite) {
    pictures::Image image = greyImage(7, 5);
    image.pixels[7 * 2 + 3].g = nan;
    image.pixels[7 * 2 + 4] = {inf, nan, 0, 1};
    image.pixels[7 * 4].a = -inf;
    EXPECT_EQ(inputError([&] { static_cast<void>(preparePicture(image, "'a.exr'")); }),
              "'a.exr': 3 pixels are not finite, the first at (3, 2)");
    image = greyImage(2, 2);
    image.pixels[1].b = inf;
    EXPECT_EQ(inputError([&] { requireFinite(image, "the reference"); }),
              "the reference: 1 pixel is not finite, the first at (1, 0)");
}

TEST(ImageCheck, RefusesAlphaWhereNoneIsExpected) {
    pictures::Image image = greyImage(3, 2);
    image.pixels[4].a = 0.5f;
    EXPECT_EQ(inputError([&] { static_cast<void>(preparePicture(image, "b.png")); }),
              "b.png: 1 pixel is not opaque (expected alpha 1), the first at (1, 1)");
    image.pixels[4].a = 1 - 1e-5f;  // a layer over its scene, rounded
    EXPECT_NO_THROW(static_cast<void>(preparePicture(image, "b.png")));
}

TEST(ImageCheck, RefusesAlphasThatAreNone) {
    pictures::Image layer = greyImage(3, 2);
    layer.pixels[5].a = 1.5f;
    EXPECT_EQ(inputError([&] { static_cast<void>(alphaOf(layer, "the layer")); }),
              "the layer: 1 pixel is outside alpha 0..1, the first at (2, 1)");
    layer.pixels[5].a = 1.0005f;
    layer.pixels[0].a = -0.0005f;
    const Plane alpha = alphaOf(layer, "the layer");
    EXPECT_EQ(alpha.at(2, 1), 1);
    EXPECT_EQ(alpha.at(0, 0), 0);
}

TEST(ImageCheck, RefusesImagesWithoutPixels) {
    EXPECT_THAT(inputError([] { static_cast<void>(preparePicture({}, "c")); }), testing::HasSubstr("c: got 0x0"));
    EXPECT_THAT(inputError([] {
                    static_cast<void>(preparePicture({2, 2, {{0, 0, 0, 1}}}, "c"));
                }),
                testing::HasSubstr("c: got 2x2 with 1 pixels"));
}

TEST(ImageCheck, EveryMetricRefusesDifferentSizes) {
    const Picture a = preparePicture(greyImage(16, 12), "a.png"), b = preparePicture(greyImage(12, 16), "b.png");
    const std::string both = "images differ in size: a.png has 16x12, b.png has 12x16";
    EXPECT_EQ(inputError([&] { static_cast<void>(pictureError(a, b)); }), both);
    EXPECT_EQ(inputError([&] { static_cast<void>(ssim(a, b)); }), both);
    EXPECT_EQ(inputError([&] { static_cast<void>(flip(a, b)); }), both);
    const Plane p(16, 12), q(12, 16);
    EXPECT_THROW(static_cast<void>(gaps(p, q)), InputError);
    EXPECT_THROW(static_cast<void>(spill(p, q)), InputError);
    EXPECT_THROW(static_cast<void>(components(p, q)), InputError);
    EXPECT_THROW(static_cast<void>(selfSimilarity(p, q, {}, 1)), InputError);
    EXPECT_THROW(static_cast<void>(cutoff(p, p, p, q)), InputError);
    EXPECT_THROW(static_cast<void>(cutoff(p, q, p, p)), InputError);
    const DustFrame good{a, a, p, p};
    EXPECT_THROW(static_cast<void>(popping(good, {b, b, q, q})), InputError);
    EXPECT_THROW(static_cast<void>(popping({a, a, p, q}, good)), InputError);
    EXPECT_THROW(static_cast<void>(popping(good, {a, b, p, p})), InputError);
}

TEST(ImageCheck, FlipRefusesViewingDistancesThatAreNone) {
    const Picture a = preparePicture(greyImage(16, 12), "a.png");
    for (const double wrong : {0.0, -67.0, 1e6, static_cast<double>(nan)})
        EXPECT_THAT(inputError([&] { static_cast<void>(flip(a, a, wrong)); }), testing::HasSubstr("allowed: 1..1000"));
}

TEST(ImageCheck, GridsMustBeWholeFiniteAndAlike) {
    const std::vector<float> eight(8, 1.0f), broken{1, nan, 1, 1, 1, inf, 1, 1};
    const GridCells good{{2, 2, 2}, eight};
    EXPECT_THAT(inputError([&] {
                    static_cast<void>(volumeError(good, {{2, 2, 2}, broken}));
                }),
                testing::HasSubstr("the grid: 2 cells are not finite"));
    EXPECT_THAT(inputError([&] {
                    static_cast<void>(volumeError(good, {{4, 2, 1}, eight}));
                }),
                testing::HasSubstr("differ in size"));
    EXPECT_THAT(inputError([&] {
                    static_cast<void>(volumeError({{3, 2, 2}, eight}, good));
                }),
                testing::HasSubstr("got 8 cells, expected 3x2x2"));
    EXPECT_THROW(static_cast<void>(volumeError({}, {})), InputError);
}

}  // namespace
}  // namespace dustbench::measure
