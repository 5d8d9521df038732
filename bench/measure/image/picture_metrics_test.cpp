// Properties of the metrics that compare two pictures, and of the heat map's colours.
#include <gtest/gtest.h>
#include <oneapi/tbb/global_control.h>
#include <oneapi/tbb/task_arena.h>

#include <numeric>

#include "bench/measure/image/colour_spaces.h"
#include "bench/measure/image/heat_map.h"
#include "bench/measure/image/picture_error.h"
#include "bench/measure/image/separable_filter.h"
#include "bench/measure/image/test_images.h"

namespace dustbench::measure {
namespace {

double meanOf(const Plane& plane) {
    return std::accumulate(plane.values.begin(), plane.values.end(), 0.0) / static_cast<double>(plane.values.size());
}

TEST(PictureMetrics, IdenticalPicturesScorePerfectly) {
    for (const TestPair& pair : {waves(), checkers(), greenAndBlue(), puffs()}) {
        const Picture picture = pictureOf(pairWidth, pairHeight, pair.image);
        const PictureError error = pictureError(picture, picture);
        EXPECT_TRUE(error.identical);
        EXPECT_FALSE(error.psnrDb);
        EXPECT_EQ(error.rmseLinear, 0);
        EXPECT_EQ(ssim(picture, picture).value, 1);
        EXPECT_EQ(flip(picture, picture).value, 0);
    }
}

TEST(PictureMetrics, AConstantOffsetHasItsClosedForm) {
    // Encoded values c and c + d everywhere: PSNR = −20 log₁₀ d, and only the brightness term of SSIM differs from 1.
    const auto even = [](float encoded) {
        return pictureOf(40, 30, [=](int, int, int) { return maths::decodeSrgb(encoded); });
    };
    const Picture a = even(0.5f), b = even(0.6f);
    EXPECT_NEAR(*pictureError(a, b).psnrDb, 20, 1e-4);
    EXPECT_NEAR(pictureError(a, b).rmseLinear, maths::decodeSrgb(0.6f) - maths::decodeSrgb(0.5f), 1e-6f);
    EXPECT_NEAR(*ssim(a, b).value, (2 * 0.5 * 0.6 + 1e-4) / (0.25 + 0.36 + 1e-4), 1e-6);
}

TEST(PictureMetrics, LightBeyondTheDisplaysRangeShowsInLinearRmseAlone) {
    const Picture a = pictureOf(20, 20, [](int, int, int) { return 1.0; });
    const Picture b = pictureOf(20, 20, [](int, int, int) { return 3.0; });
    EXPECT_TRUE(pictureError(a, b).identical);
    EXPECT_FALSE(pictureError(a, b).psnrDb);
    EXPECT_NEAR(pictureError(a, b).rmseLinear, 2, 1e-9);
    EXPECT_EQ(flip(a, b).value, 0);
}

TEST(PictureMetrics, MapsSumUpToTheirNumbers) {
    const Picture a = pictureOf(pairWidth, pairHeight, waves().reference);
    const Picture b = pictureOf(pairWidth, pairHeight, waves().image);
    const Measured similarity = ssim(a, b), seen = flip(a, b);
    EXPECT_EQ(similarity.map.width, pairWidth - 10);
    EXPECT_EQ(similarity.map.height, pairHeight - 10);
    EXPECT_NEAR(meanOf(similarity.map), *similarity.value, 1e-6);
    EXPECT_NEAR(meanOf(seen.map), *seen.value, 1e-6);
    const PictureError error = pictureError(a, b);
    double squares = 0;
    for (const float value : error.encodedRms.values)
        squares += static_cast<double>(value) * static_cast<double>(value);
    EXPECT_NEAR(-10 * std::log10(squares / error.encodedRms.values.size()), *error.psnrDb, 1e-5);
}

TEST(PictureMetrics, AreEvenInTheirArguments) {
    const Picture a = pictureOf(pairWidth, pairHeight, waves().reference);
    const Picture b = pictureOf(pairWidth, pairHeight, waves().image);
    EXPECT_NEAR(*ssim(a, b).value, *ssim(b, a).value, 1e-12);
    EXPECT_NEAR(*flip(a, b).value, *flip(b, a).value, 1e-7);
    EXPECT_EQ(pictureError(a, b).psnrDb, pictureError(b, a).psnrDb);
}

TEST(PictureMetrics, FlipAtItsLargestIsOneBetweenGreenAndBlue) {
    // No edges, so features do not raise the error.
    const Picture green = pictureOf(30, 30, [](int, int, int c) { return c == 1 ? 1.0 : 0.0; });
    const Picture blue = pictureOf(30, 30, [](int, int, int c) { return c == 2 ? 1.0 : 0.0; });
    EXPECT_NEAR(*flip(green, blue).value, 1, 1e-5);
}

TEST(PictureMetrics, APictureSmallerThanAWindowHasNoSsim) {
    const auto grey = [](int, int, int) { return 0.5; };
    EXPECT_FALSE(ssim(pictureOf(10, 40, grey), pictureOf(10, 40, grey)).value);
    EXPECT_TRUE(ssim(pictureOf(11, 11, grey), pictureOf(11, 11, grey)).value);
    // The other metrics are defined down to a single pixel.
    const auto white = [](int, int, int) { return 1.0; };
    EXPECT_GT(*flip(pictureOf(1, 1, grey), pictureOf(1, 1, white)).value, 0);
}

TEST(PictureMetrics, AreTheSameBitForBitAtAnyNumberOfThreads) {
    std::vector<std::vector<float>> maps;
    for (const int threads : {1, 2, 7}) {
        const oneapi::tbb::global_control limit(oneapi::tbb::global_control::max_allowed_parallelism, 8);
        oneapi::tbb::task_arena arena(threads);
        arena.execute([&] {
            const Picture a = pictureOf(pairWidth, pairHeight, waves().reference);
            const Picture b = pictureOf(pairWidth, pairHeight, waves().image);
            maps.push_back(flip(a, b).map.values);
            const Plane similarity = ssim(a, b).map;
            maps.back().insert(maps.back().end(), similarity.values.begin(), similarity.values.end());
        });
    }
    EXPECT_EQ(maps[0], maps[1]);
    EXPECT_EQ(maps[0], maps[2]);
}

TEST(SeparableFilter, EqualsTheSumInTwoDimensions) {
    const Plane plane = planeOf(9, 7, [](int x, int y) { return std::sin(3.0 * x + 5 * y * y); });
    const std::vector<float> kernel{0.1f, -0.3f, 0.5f, 0.2f, 0.4f};
    const Plane result = blur<float>(plane, kernel);
    for (int y = 0; y < 7; ++y)
        for (int x = 0; x < 9; ++x) {
            double sum = 0;
            for (int j = -2; j <= 2; ++j)
                for (int i = -2; i <= 2; ++i)
                    sum += static_cast<double>(kernel[static_cast<std::size_t>(i + 2)]) *
                           static_cast<double>(kernel[static_cast<std::size_t>(j + 2)]) *
                           static_cast<double>(plane.at(std::clamp(x + i, 0, 8), std::clamp(y + j, 0, 6)));
            EXPECT_NEAR(result.at(x, y), sum, 1e-6);
        }
}

TEST(ColourSpaces, MeetKnownColours) {
    // White and grey have no chroma; L* of 18 % grey is 49.496. Red of sRGB under D65: L* 53.24, a* 80.09, b* 67.20.
    const glm::vec3 white = labFromLinear({1, 1, 1}), grey = labFromLinear({0.18f, 0.18f, 0.18f});
    EXPECT_NEAR(white.x, 100, 1e-3);
    EXPECT_NEAR(white.y, 0, 1e-3);
    EXPECT_NEAR(white.z, 0, 1e-3);
    EXPECT_NEAR(grey.x, 49.496, 1e-3);
    const glm::vec3 red = labFromLinear({1, 0, 0});
    EXPECT_NEAR(red.x, 53.24, 0.01);
    EXPECT_NEAR(red.y, 80.09, 0.02);
    EXPECT_NEAR(red.z, 67.20, 0.02);
}

TEST(ColourSpaces, ComeBack) {
    for (const glm::vec3 colour : {glm::vec3(0.2f, 0.5f, 0.9f), glm::vec3(0), glm::vec3(1), glm::vec3(0.001f, 0, 0)})
        for (int channel = 0; channel < 3; ++channel) {
            EXPECT_NEAR(linearFromLab(labFromLinear(colour))[channel], colour[channel], 1e-5);
            EXPECT_NEAR(linearFromOpponent(opponentFromLinear(colour))[channel], colour[channel], 1e-5);
        }
}

TEST(HeatMap, GetsLighterEvenlyAndStaysWithinTheDisplaysColours) {
    for (int i = 0; i <= 200; ++i) {
        const float share = static_cast<float>(i) / 200;
        const glm::vec3 colour = heatColour(share);
        EXPECT_NEAR(labFromLinear(colour).x, 2 + 94 * share, 0.01) << share;
        for (int channel = 0; channel < 3; ++channel) {
            EXPECT_GE(colour[channel], -1e-3f) << share;
            EXPECT_LE(colour[channel], 1 + 1e-3f) << share;
        }
    }
    EXPECT_EQ(heatColour(-3), heatColour(0));
    EXPECT_EQ(heatColour(3), heatColour(1));
}

TEST(HeatMap, SpansTheRangeThatItIsGiven) {
    const Plane ramp = planeOf(3, 1, [](int x, int) { return 10 + 10 * x; });
    const pictures::Image image = heatMap(ramp, 10, 30);
    for (int x = 0; x < 3; ++x) EXPECT_EQ(glm::vec3(image.at(x, 0)), heatColour(0.5f * static_cast<float>(x)));
    EXPECT_EQ(image.at(1, 0).a, 1);
    EXPECT_THROW(static_cast<void>(heatMap(ramp, 1, 1)), std::invalid_argument);
}

}  // namespace
}  // namespace dustbench::measure
