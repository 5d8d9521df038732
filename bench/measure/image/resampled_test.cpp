#include "bench/measure/image/resampled.h"

#include <gtest/gtest.h>

#include "bench/measure/image/test_images.h"

namespace dustbench::measure {
namespace {

TEST(Resampled, AveragesInLinearLight) {
    // Stripes of black and white, two pixels each, made four times as narrow: half of white's light everywhere.
    const auto stripes = imageOf(256, 64, [](int x, int, int) { return x / 2 % 2 == 0 ? 1.0 : 0.0; });
    const pictures::Image half = resampled(stripes, 32, 8);
    for (int y = 0; y < 8; ++y)
        for (int x = 2; x < 30; ++x) EXPECT_NEAR(half.at(x, y).g, 0.5, 0.02) << x;
}

TEST(Resampled, StaysWithinTheImagesRangeAndPlace) {
    const auto edge = imageOf(200, 150, [](int x, int y, int) { return x >= 100 && y >= 75 ? 0.9 : 0.05; });
    for (const auto& [width, height] : {std::pair(80, 60), {128, 96}, {400, 300}}) {
        const pictures::Image image = resampled(edge, width, height);
        for (const glm::vec4& pixel : image.pixels) {
            ASSERT_GE(pixel.r, 0.05f - 1e-5f);
            ASSERT_LE(pixel.r, 0.9f + 1e-5f);
        }
        // The edge is where it was: at its middle the value is half way.
        const float before = image.at(width / 2 - 1, height - 2).r, after = image.at(width / 2, height - 2).r;
        EXPECT_NEAR((before + after) / 2, (0.05 + 0.9) / 2, 0.01);
        EXPECT_LT(before, after);
    }
    EXPECT_EQ(resampled(edge, 200, 150).pixels, edge.pixels);
}

}  // namespace
}  // namespace dustbench::measure
