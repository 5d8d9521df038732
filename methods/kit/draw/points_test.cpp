#include "methods/kit/draw/points.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "methods/kit/draw/billboards.h"
#include "methods/kit/draw/test_canvas.h"

namespace dustbench::draw {
namespace {

class PointCanvas : public TestCanvas {
 public:
    PointCanvas() : TestCanvas(160, 120, {0, 0, 0}, {0, 0, -1}) {}

    pictures::Image draw(Points& points, const std::vector<float>& values) {
        std::ranges::copy(values, points.map(values.size() / 8, Points::layout()).begin());
        points.unmap();
        return picture([&](const gpu::Layer& layer) { points.draw(view, layer); });
    }
    [[nodiscard]] std::vector<float> inTheMiddle(float radius, float opacity, float distance = 10) const {
        // The centre of pixel (80, 60), so that a sprite of odd width is symmetric.
        const glm::vec3 place = view.rayDirection(80.5, 60.5);
        const glm::vec3 at = place * (distance / -place.z);
        return {at.x, at.y, at.z, radius, opacity, 1, 0.5f, 0.25f};
    }
};

TEST(Points, AreSquaresOfTheirPixelsAndOpacity) {
    PointCanvas canvas;
    Points points(TestCanvas::device(), {false, 4, false});
    const pictures::Image image = canvas.draw(points, canvas.inTheMiddle(1, 0.25f));
    int covered = 0;
    for (const glm::vec4& pixel : image.pixels) {
        if (pixel.a == 0) continue;
        ++covered;
        EXPECT_NEAR(pixel.a, 0.25f, 1e-6f);
        EXPECT_NEAR(pixel.g, 0.125f, 1e-6f);
    }
    EXPECT_EQ(covered, 16);
}

TEST(Points, AsSpritesShowWhatABillboardShowsInTheMiddleOfTheView) {
    PointCanvas canvas;
    const float opacity = 0.8f, distance = 10;
    // 3r is an odd number of pixels wide.
    const float pixelMetres = distance / (canvas.view.eyeToClip()[1][1] * 60);
    const float radius = 21 * pixelMetres / 3;
    Points sprites(TestCanvas::device(), {true, 0, false});
    Billboards billboards(TestCanvas::device(), {Facing::viewplane, false, false});
    const std::vector<float> values = canvas.inTheMiddle(radius, opacity, distance);
    const pictures::Image sprite = canvas.draw(sprites, values);
    std::ranges::copy(values, billboards.map(1, billboards.layout(true)).begin());
    billboards.unmap();
    const pictures::Image billboard =
        canvas.picture([&](const gpu::Layer& layer) { billboards.draw(canvas.view, glm::vec3(1), layer); });
    double sum = 0;
    for (std::size_t i = 0; i < sprite.pixels.size(); ++i) {
        ASSERT_NEAR(sprite.pixels[i].a, billboard.pixels[i].a, 0.012f) << i % 160 << " " << i / 160;
        sum += static_cast<double>(sprite.pixels[i].a);
    }
    EXPECT_GT(sum, 50);
}

TEST(Points, AddLightAndCoverNothingWhereAdditive) {
    PointCanvas canvas;
    Points points(TestCanvas::device(), {false, 4, true});
    std::vector<float> two = canvas.inTheMiddle(1, 0.5f);
    const std::vector<float> one = two;
    two.insert(two.end(), one.begin(), one.end());
    for (const glm::vec4& pixel : canvas.draw(points, two).pixels) {
        EXPECT_EQ(pixel.a, 0);
        EXPECT_TRUE(pixel.r == 0 || std::abs(pixel.r - 1.0f) < 1e-6f);
    }
}

TEST(Lines, GoBackAlongTheVelocity) {
    PointCanvas canvas;
    Lines lines(TestCanvas::device(), {0.5f, false});
    const auto values = lines.map(1, Lines::layout());
    const float ten[]{0, 0, -10, 4, 0, 0, 0.5f, 1, 1, 1};
    std::ranges::copy(ten, values.begin());
    lines.unmap();
    const pictures::Image image = canvas.picture([&](const gpu::Layer& layer) { lines.draw(canvas.view, layer); });
    const float pixelMetres = 10 / (canvas.view.eyeToClip()[1][1] * 60);
    int covered = 0, right = 0;
    for (std::size_t i = 0; i < image.pixels.size(); ++i) {
        if (image.pixels[i].a == 0) continue;
        ++covered;
        right += i % 160 > 80;
        EXPECT_NEAR(image.pixels[i].a, 0.5f, 1e-6f);
    }
    EXPECT_NEAR(static_cast<float>(covered), 2 / pixelMetres, 2);
    EXPECT_EQ(right, 0);
}

}  // namespace
}  // namespace dustbench::draw
