#include "bench/view/split_view.h"

#include <gtest/gtest.h>

#include <random>
#include <span>
#include <vector>

#include "methods/kit/draw/read_back.h"

namespace dustbench::bench {
namespace {

constexpr int width = 40, height = 30;
constexpr float step = 1.0f / 255;

class Split : public testing::Test {
 protected:
    Split()
        : a_(noise(1)),
          b_(noise(2)),
          result_(gpu::Texture::make2D(device_, "split", gpu::Format::rgba8, width, height)),
          target_(device_, "split", &result_, nullptr),
          split_(device_) {}

    gpu::Texture noise(unsigned seed) {
        std::mt19937 random(seed);
        std::vector<std::uint8_t> values(4 * width * height);
        for (std::uint8_t& value : values) value = static_cast<std::uint8_t>(random());
        gpu::Texture texture = gpu::Texture::make2D(device_, "noise", gpu::Format::rgba8, width, height);
        texture.write(std::span<const std::uint8_t>(values));
        return texture;
    }
    pictures::Image drawn(const gpu::Texture& a, const gpu::Texture& b, const SplitSettings& settings) {
        split_.draw(a, b, settings, target_, width, height);
        return draw::readBack(result_);
    }

    gpu::Device device_;
    gpu::Texture a_, b_, result_;
    gpu::Framebuffer target_;
    SplitView split_;
};

TEST_F(Split, ShowsAUpToTheDividerAndBBeyond) {
    const pictures::Image a = draw::readBack(a_), b = draw::readBack(b_);
    for (const int divided : {0, 7, 20, 40}) {
        const auto share = static_cast<float>(divided) / width;
        const pictures::Image image = drawn(a_, b_, {Shown::wipe, share});
        for (int y = 0; y < height; ++y)
            for (int x = 0; x < width; ++x) {
                if (divided % width != 0 && std::abs(x + 0.5f - static_cast<float>(divided)) <= 1)
                    continue;  // the line
                ASSERT_EQ(glm::vec3(image.at(x, y)), glm::vec3((x < divided ? a : b).at(x, y)))
                    << x << " of " << divided;
            }
    }
    EXPECT_EQ(glm::vec3(drawn(a_, b_, {Shown::a, 0}).at(30, 3)), glm::vec3(a.at(30, 3)));
    EXPECT_EQ(glm::vec3(drawn(a_, b_, {Shown::b, 1}).at(3, 3)), glm::vec3(b.at(3, 3)));
}

TEST_F(Split, DifferenceIsGreyWhereTheyAgreeAndSigned) {
    const pictures::Image same = drawn(a_, a_, {Shown::difference, 0.5f, 10});
    for (const glm::vec4& pixel : same.pixels) ASSERT_NEAR(pixel.r, 0.5f, step);
    const pictures::Image a = draw::readBack(a_), b = draw::readBack(b_);
    const pictures::Image image = drawn(a_, b_, {Shown::difference, 0.5f, 1});
    for (std::size_t i = 0; i < image.pixels.size(); ++i)
        for (int channel = 0; channel < 3; ++channel)
            ASSERT_NEAR(image.pixels[i][channel], 0.5f + 0.5f * (b.pixels[i][channel] - a.pixels[i][channel]), step);
}

TEST_F(Split, EnlargesPixelsAsTheyAre) {
    SplitSettings quarter{Shown::a};
    quarter.origin = {0.5f, 0.5f};  // the upper right
    quarter.extent = {0.5f, 0.5f};
    const pictures::Image a = draw::readBack(a_), image = drawn(a_, b_, quarter);
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x)
            ASSERT_EQ(glm::vec3(image.at(x, y)), glm::vec3(a.at(width / 2 + x / 2, y / 2))) << x << ' ' << y;
}

TEST_F(Split, RefusesPicturesOfTwoSizes) {
    const gpu::Texture small = gpu::Texture::make2D(device_, "small", gpu::Format::rgba8, 4, 4);
    EXPECT_THROW(split_.draw(a_, small, {}, target_, width, height), std::invalid_argument);
}

}  // namespace
}  // namespace dustbench::bench
