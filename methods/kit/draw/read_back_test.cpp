#include "methods/kit/draw/read_back.h"

#include <gtest/gtest.h>

#include <numeric>
#include <span>
#include <stdexcept>
#include <vector>

#include "methods/kit/draw/test_canvas.h"
#include "methods/kit/gpu/texture.h"

namespace dustbench::draw {
namespace {

TEST(ReadBack, HasItsFirstRowAtTheTop) {
    gpu::Device& device = TestCanvas::device();
    gpu::Texture texture = gpu::Texture::make2D(device, "test", gpu::Format::rgba32F, 2, 3);
    std::vector<float> values(24);
    std::iota(values.begin(), values.end(), 0.0f);
    texture.write(std::span<const float>(values));
    const pictures::Image image = readBack(texture);
    ASSERT_EQ(image.width, 2);
    ASSERT_EQ(image.height, 3);
    EXPECT_EQ(image.at(0, 2), glm::vec4(0, 1, 2, 3));
    EXPECT_EQ(image.at(1, 0), glm::vec4(20, 21, 22, 23));
}

TEST(ReadBack, RefusesDepth) {
    gpu::Device& device = TestCanvas::device();
    EXPECT_THROW(static_cast<void>(readBack(gpu::Texture::make2D(device, "test", gpu::Format::depth32F, 2, 2))),
                 std::invalid_argument);
}

}  // namespace
}  // namespace dustbench::draw
