#include "methods/kit/draw/puff_noise.h"

#include <gtest/gtest.h>

#include <cmath>

namespace dustbench::draw {
namespace {

TEST(PuffNoise, HasNoMeanOverPuffsAndStaysWithinItsBounds) {
    constexpr int count = 60'000;
    double sum = 0, squares = 0;
    for (int i = 0; i < count; ++i) {
        const float value = plainNoise(noiseOf(static_cast<std::uint64_t>(i), 1, {}, {0.5f, 0.6f}).place);
        ASSERT_LE(std::abs(value), 1);
        sum += static_cast<double>(value);
        squares += static_cast<double>(value) * static_cast<double>(value);
    }
    const double rms = std::sqrt(squares / count);
    EXPECT_GT(rms, 0.35) << "it is seen";
    EXPECT_LT(rms, 0.8);
    EXPECT_LT(std::abs(sum / count), 4.9 * rms / std::sqrt(count));
}

TEST(PuffNoise, IsContinuousAndVariesWithinACell) {
    double steepest = 0, least = 1, most = -1;
    for (int i = 0; i < 4000; ++i) {
        const glm::vec3 q(3 + 0.002f * static_cast<float>(i), 5.3f, -7.1f);
        const double value = static_cast<double>(plainNoise(q)),
                     next = static_cast<double>(plainNoise(q + glm::vec3(0.002f, 0, 0)));
        steepest = std::max(steepest, std::abs(next - value) / 0.002);
        least = std::min(least, value);
        most = std::max(most, value);
    }
    EXPECT_LT(steepest, 8);
    EXPECT_GT(most - least, 0.8);
}

TEST(PuffNoise, IsThatOfThePuffItself) {
    const NoiseSettings settings{1, 0.5f};
    const glm::vec3 away(0.3f, -0.2f, 0.1f);
    const NoisePlace centre = noiseOf(7, 2, {}, settings), shifted = noiseOf(7, 2, away, settings);
    EXPECT_FLOAT_EQ(centre.metres, 1);
    EXPECT_LT(glm::distance(shifted.place - centre.place, away / centre.metres), 1e-4f);
    // Twice the radius: the pattern has grown with the puff.
    EXPECT_LT(glm::distance(noiseOf(7, 4, 2.0f * away, settings).place, shifted.place), 1e-4f);
    EXPECT_GT(glm::distance(noiseOf(8, 2, {}, settings).place, centre.place), 1);
}

}  // namespace
}  // namespace dustbench::draw
