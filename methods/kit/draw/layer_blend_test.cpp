#include "methods/kit/draw/layer_blend.h"

#include <gtest/gtest.h>

#include <random>
#include <span>
#include <vector>

#include "methods/kit/draw/read_back.h"
#include "methods/kit/draw/test_canvas.h"
#include "methods/kit/pictures/image.h"

namespace dustbench::draw {
namespace {

gpu::Texture filled(gpu::Device& device, gpu::Format format, int width, int height, float brightest, unsigned seed) {
    std::mt19937 engine(seed);
    std::uniform_real_distribution<float> share(0, 1);
    std::vector<float> values;
    for (int i = 0; i < width * height; ++i) {
        const float alpha = share(engine);
        for (int channel = 0; channel < 3; ++channel) {
            const float value = share(engine);
            values.push_back(brightest * alpha * value * value * value);  // many dark values
        }
        values.push_back(alpha);
    }
    gpu::Texture texture = gpu::Texture::make2D(device, "test", format, width, height);
    texture.write(std::span<const float>(values));
    return texture;
}

TEST(Composite, EqualsOverAndEncodingOnTheCpuToOneStep) {
    gpu::Device& device = TestCanvas::device();
    const gpu::Texture scene = filled(device, gpu::Format::rgba16F, 61, 47, 1.6f, 1);
    const gpu::Texture layer = filled(device, gpu::Format::rgba32F, 61, 47, 1, 2);
    Composite composite(device, 61, 47);
    composite.draw(scene, layer);
    const pictures::Image expected = pictures::over(readBack(layer), readBack(scene));
    const pictures::Image got = readBack(composite.result());
    double offBy = 0;
    for (std::size_t i = 0; i < got.pixels.size(); ++i) {
        for (int channel = 0; channel < 3; ++channel) {
            const float want = maths::encodeSrgb(expected.pixels[i][channel]);
            EXPECT_NEAR(got.pixels[i][channel], want, 1.0f / 255);
            offBy += std::abs(static_cast<double>(got.pixels[i][channel] - want));
        }
        EXPECT_EQ(got.pixels[i].a, 1);
    }
    // Rounding alone causes a quarter of a step on average.
    EXPECT_LT(offBy / (3.0 * 61 * 47), 0.27 / 255);
}

TEST(Composite, HasTheSizeThatItIsGiven) {
    gpu::Device& device = TestCanvas::device();
    Composite resized(device, 8, 8), made(device, 23, 11);
    resized.resize(23, 11);
    const gpu::Texture scene = filled(device, gpu::Format::rgba16F, 23, 11, 1, 3);
    const gpu::Texture layer = filled(device, gpu::Format::rgba32F, 23, 11, 1, 4);
    for (Composite* composite : {&resized, &made}) composite->draw(scene, layer);
    EXPECT_EQ(readBack(resized.result()).pixels, readBack(made.result()).pixels);
    EXPECT_EQ(resized.result().width(), 23);
}

TEST(Composite, RefusesOtherSizes) {
    gpu::Device& device = TestCanvas::device();
    Composite composite(device, 8, 8);
    const gpu::Texture right = filled(device, gpu::Format::rgba32F, 8, 8, 1, 1);
    const gpu::Texture wrong = filled(device, gpu::Format::rgba32F, 8, 9, 1, 1);
    EXPECT_THROW(composite.draw(right, wrong), std::invalid_argument);
    EXPECT_THROW(composite.draw(wrong, right), std::invalid_argument);
}

}  // namespace
}  // namespace dustbench::draw
