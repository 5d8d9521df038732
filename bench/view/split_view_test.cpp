#include "bench/view/split_view.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <span>
#include <vector>

#include "methods/kit/draw/read_back.h"

namespace dustbench::view {
namespace {

constexpr int splitWidth = 40, splitHeight = 30;
constexpr float step = 1.0f / 255;
constexpr double nearMetres = 0.1;

class Split : public testing::Test {
 protected:
    Split()
        : a_(noise(1)),
          b_(noise(2)),
          result_(gpu::Texture::make2D(device_, "split", gpu::Format::rgba8, splitWidth, splitHeight)),
          target_(device_, "split", &result_, nullptr),
          split_(device_) {}

    gpu::Texture noise(unsigned seed) {
        std::mt19937 random(seed);
        std::vector<std::uint8_t> values(4 * splitWidth * splitHeight);
        for (std::uint8_t& value : values) value = static_cast<std::uint8_t>(random());
        gpu::Texture texture = gpu::Texture::make2D(device_, "noise", gpu::Format::rgba8, splitWidth, splitHeight);
        texture.write(std::span<const std::uint8_t>(values));
        return texture;
    }
    static HalfTextures all(const gpu::Texture& texture) { return {texture, texture, texture, texture}; }
    pictures::Image drawn(const gpu::Texture& a, const gpu::Texture& b, const SplitSettings& settings) {
        return drawn(all(a), all(b), settings);
    }
    pictures::Image drawn(const HalfTextures& a, const HalfTextures& b, const SplitSettings& settings) {
        split_.draw(a, b, settings, nearMetres, target_, splitWidth, splitHeight);
        return draw::readBack(result_);
    }
    /// Four numbers per pixel, from the lower left corner.
    gpu::Texture light(const std::vector<float>& values) {
        gpu::Texture texture = gpu::Texture::make2D(device_, "light", gpu::Format::rgba32F, splitWidth, splitHeight);
        texture.write(std::span<const float>(values));
        return texture;
    }
    static std::vector<float> randomLight(unsigned seed, float limit) {
        std::mt19937 random(seed);
        std::uniform_real_distribution<float> upTo(0, limit);
        std::vector<float> values(4 * splitWidth * splitHeight);
        for (std::size_t i = 0; i < values.size(); ++i) values[i] = i % 4 == 3 ? upTo(random) / limit : upTo(random);
        return values;
    }

    gpu::Device device_;
    gpu::Texture a_, b_, result_;
    gpu::Framebuffer target_;
    SplitView split_;
};

TEST_F(Split, ShowsAUpToTheDividerAndBBeyond) {
    const pictures::Image a = draw::readBack(a_), b = draw::readBack(b_);
    for (const int divided : {0, 7, 20, 40}) {
        const auto share = static_cast<float>(divided) / splitWidth;
        const pictures::Image image = drawn(a_, b_, {Shown::wipe, share});
        for (int y = 0; y < splitHeight; ++y)
            for (int x = 0; x < splitWidth; ++x) {
                if (divided % splitWidth != 0 && std::abs(x + 0.5f - static_cast<float>(divided)) <= 1)
                    continue;  // the line
                ASSERT_EQ(glm::vec3(image.at(x, y)), glm::vec3((x < divided ? a : b).at(x, y)))
                    << x << " of " << divided;
            }
    }
    EXPECT_EQ(glm::vec3(drawn(a_, b_, {Shown::a, 0}).at(30, 3)), glm::vec3(a.at(30, 3)));
    EXPECT_EQ(glm::vec3(drawn(a_, b_, {Shown::b, 1}).at(3, 3)), glm::vec3(b.at(3, 3)));
}

TEST_F(Split, InterpolatesPicturesSmallerThanTheTarget) {
    constexpr int smallWidth = splitWidth / 4, smallHeight = splitHeight / 4;
    // A ramp to the right and up: bilinear interpolation keeps it, apart from half a pixel at the edges.
    std::vector<std::uint8_t> values;
    for (int y = 0; y < smallHeight; ++y)
        for (int x = 0; x < smallWidth; ++x)
            for (const int value : {20 * x, 30 * y, 5 * (x + y), 255})
                values.push_back(static_cast<std::uint8_t>(value));
    gpu::Texture ramp = gpu::Texture::make2D(device_, "ramp", gpu::Format::rgba8, smallWidth, smallHeight);
    ramp.write(std::span<const std::uint8_t>(values));
    const auto placeOf = [](int pixel, int of, int texels) {
        const float place = (static_cast<float>(pixel) + 0.5f) / static_cast<float>(of) * static_cast<float>(texels);
        return std::clamp(place - 0.5f, 0.0f, static_cast<float>(texels - 1));
    };
    const pictures::Image image = drawn(ramp, ramp, {Shown::a});
    for (int y = 0; y < splitHeight; ++y)
        for (int x = 0; x < splitWidth; ++x) {
            const float right = placeOf(x, splitWidth, smallWidth);
            const float up = placeOf(splitHeight - 1 - y, splitHeight, smallHeight);
            const glm::vec4 pixel = image.at(x, y);
            ASSERT_NEAR(pixel.r, 20 * right / 255, step) << x << " " << y;
            ASSERT_NEAR(pixel.g, 30 * up / 255, step) << x << " " << y;
        }
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
    for (int y = 0; y < splitHeight; ++y)
        for (int x = 0; x < splitWidth; ++x)
            ASSERT_EQ(glm::vec3(image.at(x, y)), glm::vec3(a.at(splitWidth / 2 + x / 2, y / 2))) << x << ' ' << y;
}

TEST_F(Split, RefusesPicturesOfTwoSizes) {
    const gpu::Texture small = gpu::Texture::make2D(device_, "small", gpu::Format::rgba8, 4, 4);
    EXPECT_THROW(split_.draw(all(a_), all(small), {}, nearMetres, target_, splitWidth, splitHeight),
                 std::invalid_argument);
}

TEST_F(Split, ShowsBothWholeSideBySide) {
    const gpu::Texture wide = gpu::Texture::make2D(device_, "wide", gpu::Format::rgba8, 2 * splitWidth, splitHeight);
    const gpu::Framebuffer target(device_, "wide", &wide, nullptr);
    split_.draw(all(a_), all(b_), {Shown::sideBySide, 0.2f}, nearMetres, target, 2 * splitWidth, splitHeight);
    const pictures::Image a = draw::readBack(a_), b = draw::readBack(b_), image = draw::readBack(wide);
    for (int y = 0; y < splitHeight; ++y)
        for (int x = 0; x < splitWidth; ++x) {
            ASSERT_EQ(glm::vec3(image.at(x, y)), glm::vec3(a.at(x, y))) << x << ' ' << y;
            ASSERT_EQ(glm::vec3(image.at(splitWidth + x, y)), glm::vec3(b.at(x, y))) << x << ' ' << y;
        }
}

TEST_F(Split, ExposureMultipliesTheLightOfSceneAndLayer) {
    const std::vector<float> scene = randomLight(3, 2), layer = randomLight(4, 0.5f);
    const gpu::Texture sceneTexture = light(scene), layerTexture = light(layer);
    const HalfTextures half{a_, sceneTexture, layerTexture, a_};
    const gpu::Texture linear = gpu::Texture::make2D(device_, "linear", gpu::Format::rgba32F, splitWidth, splitHeight);
    const gpu::Framebuffer target(device_, "linear", &linear, nullptr);
    for (const float stops : {-3.0f, 1.0f, 2.5f}) {
        SplitSettings settings;
        settings.stops = stops;
        const pictures::Image image = drawn(half, half, settings);
        settings.encoded = false;
        split_.draw(half, half, settings, nearMetres, target, splitWidth, splitHeight);
        const std::vector<float> values = linear.readFloats();
        for (int y = 0; y < splitHeight; ++y)
            for (int x = 0; x < splitWidth; ++x) {
                if (std::abs(x + 0.5f - 0.5f * static_cast<float>(splitWidth)) <= 1) continue;  // the divider's line
                const std::size_t i = 4 * static_cast<std::size_t>(y * splitWidth + x);
                for (std::size_t channel = 0; channel < 3; ++channel) {
                    const float expected =
                        std::exp2(stops) * (layer[i + channel] + (1 - layer[i + 3]) * scene[i + channel]);
                    ASSERT_NEAR(values[i + channel], expected, 1e-5f * std::max(expected, 1.0f));
                    ASSERT_NEAR(image.at(x, splitHeight - 1 - y)[static_cast<int>(channel)],
                                pictures::encodeSrgb(expected), 0.6f * step);
                }
            }
    }
}

TEST_F(Split, ShowsAlphaAndTheLogarithmOfTheDepth) {
    const std::vector<float> layer = randomLight(5, 1);
    std::vector<float> depth(static_cast<std::size_t>(splitWidth * splitHeight));
    std::mt19937 random(6);
    std::uniform_real_distribution<double> exponent(-1, 4);
    for (float& value : depth) value = static_cast<float>(nearMetres / std::pow(10.0, exponent(random)));
    depth[0] = 0;  // sky
    const gpu::Texture layerTexture = light(layer);
    gpu::Texture depthTexture = gpu::Texture::make2D(device_, "depth", gpu::Format::r32F, splitWidth, splitHeight);
    depthTexture.write(std::span<const float>(depth));
    const HalfTextures half{a_, a_, layerTexture, depthTexture};
    SplitSettings settings{Shown::a};
    settings.channel = Channel::alpha;
    const pictures::Image alpha = drawn(half, half, settings);
    settings.channel = Channel::depth;
    const pictures::Image grey = drawn(half, half, settings);
    for (int y = 0; y < splitHeight; ++y)
        for (int x = 0; x < splitWidth; ++x) {
            const auto i = static_cast<std::size_t>(y * splitWidth + x);
            ASSERT_NEAR(alpha.at(x, splitHeight - 1 - y).r, layer[4 * i + 3], 0.6f * step);
            const double metres = nearMetres / std::max(static_cast<double>(depth[i]), 1e-9);
            ASSERT_NEAR(grey.at(x, splitHeight - 1 - y).g, std::clamp(1 - std::log10(metres) / 3, 0.0, 1.0),
                        0.6f * step);
        }
}

TEST_F(Split, MarksValuesThatAPictureCannotHave) {
    std::vector<float> layer(4 * splitWidth * splitHeight, 0.5f);
    const auto at = [&](int x, int y) { return &layer[4 * static_cast<std::size_t>(y * splitWidth + x)]; };
    at(3, 2)[1] = std::numeric_limits<float>::quiet_NaN();
    at(4, 2)[3] = std::numeric_limits<float>::infinity();
    at(5, 2)[0] = -std::numeric_limits<float>::infinity();
    at(6, 2)[2] = -1e-20f;
    at(7, 2)[3] = 1.01f;
    at(8, 2)[3] = 1.0005f;  // within rounding
    const gpu::Texture layerTexture = light(layer), scene = light(randomLight(7, 1));
    SplitSettings settings{Shown::a};
    settings.channel = Channel::faults;
    const HalfTextures half{a_, scene, layerTexture, a_};
    const pictures::Image image = drawn(half, half, settings);
    const auto colour = [&](int x) { return glm::vec3(image.at(x, splitHeight - 1 - 2)); };
    for (const int x : {3, 4, 5}) EXPECT_EQ(colour(x), glm::vec3(1, 0, 1)) << x;
    EXPECT_EQ(colour(6), glm::vec3(0, 1, 1));
    EXPECT_EQ(colour(7), glm::vec3(1, 1, 0));
    int coloured = 0;
    for (const glm::vec4& pixel : image.pixels) coloured += pixel.r != pixel.g || pixel.g != pixel.b;
    EXPECT_EQ(coloured, 5);
}

}  // namespace
}  // namespace dustbench::view
