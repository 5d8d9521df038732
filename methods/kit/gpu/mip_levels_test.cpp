#include "methods/kit/gpu/mip_levels.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "methods/kit/gpu/texture.h"
#include "methods/kit/maths/srgb.h"

namespace dustbench::gpu {
namespace {

TEST(MipLevels, HalveEachSideDownToOneTexel) {
    const std::vector<std::uint8_t> values(13 * 6, 77);
    const auto levels = mipLevelsOf(values, 13, 6, 1, false);
    ASSERT_EQ(levels.size(), 3u);
    EXPECT_EQ(levels[0].width, 6);
    EXPECT_EQ(levels[0].height, 3);
    EXPECT_EQ(levels[1].width, 3);
    EXPECT_EQ(levels[1].height, 1);
    EXPECT_EQ(levels[2].values.size(), 1u);
    for (const MipLevel& level : levels)
        for (const std::uint8_t value : level.values) EXPECT_EQ(value, 77);
}

TEST(MipLevels, OfColoursAreMeansOfLightAndOfAlphaMeansOfItsBytes) {
    const std::vector<std::uint8_t> values{0, 0, 100, 0, 255, 255, 200, 101};
    const auto levels = mipLevelsOf(values, 2, 1, 4, true);
    ASSERT_EQ(levels.size(), 1u);
    const float mean = (maths::decodeSrgb(100.0f / 255) + maths::decodeSrgb(200.0f / 255)) / 2;
    EXPECT_EQ(levels[0].values,
              (std::vector<std::uint8_t>{188, 188,
                                         static_cast<std::uint8_t>(std::lround(255 * maths::encodeSrgb(mean))), 51}));
}

TEST(MipLevels, HoldTheMeanOfThePictureWhateverItsSize) {
    std::mt19937 random(3);
    for (const auto& [width, height] : {std::pair(64, 32), std::pair(63, 33), std::pair(37, 5), std::pair(1, 97)}) {
        std::vector<std::uint8_t> values(static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
        double sum = 0;
        for (std::uint8_t& value : values) sum += value = static_cast<std::uint8_t>(random() % 256);
        const double mean = sum / static_cast<double>(values.size());
        for (const MipLevel& level : mipLevelsOf(values, width, height, 1, false)) {
            double ofLevel = 0;
            for (const std::uint8_t value : level.values) ofLevel += value;
            EXPECT_NEAR(ofLevel / static_cast<double>(level.values.size()), mean, 0.51) << width << 'x' << height;
        }
    }
}

}  // namespace
}  // namespace dustbench::gpu
