#include "methods/kit/draw/ground_pass.h"

#include <gtest/gtest.h>

#include <cmath>

#include "methods/kit/pictures/image.h"

namespace dustbench::draw {
namespace {

const glm::vec3 albedo(0.32f, 0.26f, 0.19f);
const glm::vec3 toSun = glm::normalize(glm::vec3(0.45f, 0.62f, 0.64f));

float channelAt(const std::vector<std::uint8_t>& bytes, int size, int x, int y, int channel) {
    const std::size_t texel = static_cast<std::size_t>((y + size) % size * size + (x + size) % size);
    return static_cast<float>(bytes[texel * 4 + static_cast<std::size_t>(channel)]) / 255;
}

/// Mean difference between the two rows (or columns) on either side of `line`.
double stepAcross(const std::vector<std::uint8_t>& bytes, int size, int line, bool rows) {
    double sum = 0;
    for (int i = 0; i < size; ++i) {
        const float here = rows ? channelAt(bytes, size, i, line, 1) : channelAt(bytes, size, line, i, 1);
        const float there = rows ? channelAt(bytes, size, i, line - 1, 1) : channelAt(bytes, size, line - 1, i, 1);
        sum += static_cast<double>(std::abs(here - there));
    }
    return sum / size;
}

void expectSeamless(const std::vector<std::uint8_t>& bytes, int size) {
    for (const bool rows : {false, true}) {
        double inside = 0;
        for (int line = 1; line < size; ++line) inside += stepAcross(bytes, size, line, rows) / (size - 1);
        EXPECT_LT(stepAcross(bytes, size, 0, rows), 1.5 * inside);
    }
}

TEST(GroundDetail, HasTheAlbedoAsItsMean) {
    const auto bytes = makeGroundDetail(albedo, toSun);
    for (int channel = 0; channel < 3; ++channel) {
        double sum = 0;
        for (int y = 0; y < detailTexels; ++y)
            for (int x = 0; x < detailTexels; ++x)
                sum += static_cast<double>(maths::decodeSrgb(channelAt(bytes, detailTexels, x, y, channel)));
        EXPECT_NEAR(sum / (detailTexels * detailTexels), albedo[channel], 0.01 * static_cast<double>(albedo[channel]));
    }
}

TEST(GroundDetail, IsSeamless) {
    expectSeamless(makeGroundDetail(albedo, toSun), detailTexels);
}

TEST(GroundPatches, AreSeamlessAndLeaveTheMeanAlone) {
    const auto& bytes = groundPatches();
    expectSeamless(bytes, patchTexels);
    double sum = 0;
    for (std::size_t i = 1; i < bytes.size(); i += 4) sum += bytes[i];
    EXPECT_NEAR(sum / (patchTexels * patchTexels), 128, 3);
}

TEST(GroundDetail, IsTheSameEveryTime) {
    EXPECT_EQ(makeGroundDetail(albedo, toSun), makeGroundDetail(albedo, toSun));
}

TEST(GroundTexture, PatchesHoldAWholeNumberOfDetailTiles) {
    EXPECT_EQ(std::remainder(patchTileMetres, detailTileMetres), 0);
}

}  // namespace
}  // namespace dustbench::draw
