// Tests the noise that billboards carry along.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <random>

#include "methods/billboard/billboard.h"
#include "methods/kit/maths/transmittance.h"
#include "methods/kit/testing/test_moment.h"

namespace dustbench::billboard {
namespace {

/// Dust in front of an eye, over an empty scene.
class NoisyDust : public TestMoment {
 public:
    explicit NoisyDust(std::size_t count) : TestMoment(count, 160, 120, {0, 2, 0}, {0, 0, -10}) {
        std::mt19937 random(3);
        std::uniform_real_distribution<float> uniform(0, 1);
        for (std::size_t i = 0; i < count; ++i) {
            dust.serial[i] = 70 + i;
            dust.x[i] = 10 * uniform(random) - 5;
            dust.y[i] = 8 * uniform(random) - 2;
            dust.z[i] = -8 - 8 * uniform(random);
            dust.radius[i] = 0.4f + uniform(random);
            dust.opacity[i] = 0.04f;
            dust.lifetime[i] = 5;
            dust.age[i] = 1;
        }
    }
    [[nodiscard]] pictures::Image drawnWith(const draw::NoiseSettings& noise) {
        Settings settings;
        settings.noise = noise;
        settings.style.noise = noise.amplitude;
        Billboard method(settings);
        method.prepare(scene, {}, device());
        return updateAndDraw(method);
    }
};

double meanAlpha(const pictures::Image& image) {
    double sum = 0;
    for (const glm::vec4& pixel : image.pixels) sum += static_cast<double>(pixel.a);
    return sum / static_cast<double>(image.pixels.size());
}

double alphaDifference(const pictures::Image& a, const pictures::Image& b) {
    double largest = 0;
    for (std::size_t i = 0; i < a.pixels.size(); ++i)
        largest = std::max(largest, std::abs(static_cast<double>(a.pixels[i].a - b.pixels[i].a)));
    return largest;
}

TEST(BillboardNoise, EqualsTheReferenceInEveryPixel) {
    const draw::NoiseSettings noise{0.9f, 0.4f};
    NoisyDust moment(1);
    const glm::dvec3 place(0.4, 2.3, -5);
    moment.dust.x[0] = 0.4f, moment.dust.y[0] = 2.3f, moment.dust.z[0] = -5;
    moment.dust.radius[0] = 1.5f;
    moment.dust.opacity[0] = 0.7f;
    const pictures::Image image = moment.drawnWith(noise);
    const glm::dvec3 centre = place - moment.view.camera.eye;
    std::size_t compared = 0;
    for (int y = 0; y < image.height; ++y)
        for (int x = 0; x < image.width; ++x) {
            const glm::dvec3 ray = moment.view.rayDirection(x + 0.5, y + 0.5);
            const double b = glm::length(centre - glm::dot(centre, ray) * ray);
            if (b > 1.2 * 1.5) continue;  // well within the quad
            // The quad is perpendicular to the ray to the centre.
            const glm::dvec3 onQuad = ray * (glm::dot(centre, centre) / glm::dot(ray, centre)) - centre;
            const float g = draw::plainNoise(draw::noiseOf(70, 1.5f, glm::vec3(onQuad), noise).place);
            const double depth =
                -std::log1p(-maths::billboardOpacity(0.7, 1.5, b)) * (1 + 0.9 * static_cast<double>(g));
            ASSERT_NEAR(static_cast<double>(image.at(x, y).a), -std::expm1(-depth), 3e-3) << x << ' ' << y;
            ++compared;
        }
    EXPECT_GT(compared, 1000u);
}

TEST(BillboardNoise, KeepsTheMeanOpacity) {
    NoisyDust moment(900);
    const pictures::Image plain = moment.drawnWith({}), noisy = moment.drawnWith({1, 0.5f});
    EXPECT_GT(alphaDifference(plain, noisy), 0.05);
    EXPECT_NEAR(meanAlpha(noisy) / meanAlpha(plain), 1, 0.015);
}

TEST(BillboardNoise, MovesAndGrowsWithThePuff) {
    const draw::NoiseSettings noise{1, 0.5f};
    NoisyDust moment(40);
    const pictures::Image first = moment.drawnWith(noise);
    const auto moved = [&](const std::function<void(NoisyDust&)>& change) {
        NoisyDust other(40);
        change(other);
        return alphaDifference(first, other.drawnWith(noise));
    };
    // A shift of eye and puffs, and a world of twice the size, look the same.
    EXPECT_LT(moved([](NoisyDust& dust) {
                  for (float& x : dust.dust.x) x += 3;
                  dust.view.camera.eye.x += 3;
                  dust.view.camera.target.x += 3;
              }),
              2e-3);
    EXPECT_LT(moved([](NoisyDust& dust) {
                  for (std::size_t i = 0; i < 40; ++i) {
                      dust.dust.x[i] *= 2, dust.dust.z[i] *= 2, dust.dust.radius[i] *= 2;
                      dust.dust.y[i] = 2 + 2 * (dust.dust.y[i] - 2);
                  }
              }),
              2e-3);
    EXPECT_GT(moved([](NoisyDust& dust) {
                  for (std::uint64_t& serial : dust.dust.serial) serial += 1000;
              }),
              0.02)
        << "every puff has its own";
}

}  // namespace
}  // namespace dustbench::billboard
