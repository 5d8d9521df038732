#include "bench/run/frame_runner.h"

#include <gtest/gtest.h>

#include <limits>

#include "methods/contract/errors.h"

namespace dustbench::run {
namespace {

std::string faultOf(const pictures::Image& picture) {
    try {
        requireFinite(picture, 119, Stage::draw, "the method's layer");
        return "";
    } catch (const SimulationError& error) {
        return error.what();
    }
}

TEST(FinitePicture, NamesFrameStagePixelAndChannel) {
    pictures::Image picture{3, 2, std::vector<glm::vec4>(6, glm::vec4(0.5f))};
    EXPECT_EQ(faultOf(picture), "");
    picture.pixels[4].b = std::numeric_limits<float>::quiet_NaN();
    EXPECT_EQ(faultOf(picture),
              "frame 119: the method's layer is not finite in 1 pixels, first in (1, 1): blue is nan (stage draw)");
    picture.pixels[2].a = -std::numeric_limits<float>::infinity();
    EXPECT_EQ(faultOf(picture),
              "frame 119: the method's layer is not finite in 2 pixels, first in (2, 0): alpha is -inf (stage draw)");
}

TEST(FinitePicture, EveryPixelAndChannelCounts) {
    for (std::size_t i = 0; i < 6; ++i)
        for (int channel = 0; channel < 4; ++channel) {
            pictures::Image picture{3, 2, std::vector<glm::vec4>(6, glm::vec4(0.5f))};
            picture.pixels[i][channel] = std::numeric_limits<float>::infinity();
            EXPECT_NE(faultOf(picture), "") << i << ' ' << channel;
        }
}

TEST(FinitePicture, LargeAndNegativeValuesAreFinite) {
    const pictures::Image picture{1, 1, {glm::vec4(-1, 65504, std::numeric_limits<float>::max(), 2)}};
    EXPECT_EQ(faultOf(picture), "");
}

}  // namespace
}  // namespace dustbench::run
