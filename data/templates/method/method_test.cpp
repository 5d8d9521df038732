#include <gtest/gtest.h>

#include <algorithm>

#include "methods/kit/testing/test_moment.h"

namespace dustbench::@ID@ {

MethodInfo describe();

namespace {

/// Two particles before an eye that looks along -z.
class TwoParticles : public TestMoment {
 public:
    TwoParticles() : TestMoment(2, 64, 48, {0, 0, 0}, {0, 0, -1}) {
        for (std::size_t i = 0; i < 2; ++i) {
            dust.x[i] = i == 0 ? -0.5f : 0.5f;
            dust.z[i] = -4;
            dust.radius[i] = 0.5f;
            dust.opacity[i] = 0.5f;
            dust.lifetime[i] = 5;
        }
        dust.colourOfAll = {0.6f, 0.4f, 0.2f};
    }
};

std::unique_ptr<Method> prepared(const TwoParticles& moment) {
    const MethodInfo info = describe();
    auto method = info.create(ParameterValues(info.parameters));
    method->prepare(moment.scene, {}, TwoParticles::device());
    return method;
}

TEST(@CLASS@, ShowsTheParticlesAndNothingElse) {
    TwoParticles moment;
    const auto method = prepared(moment);
    const pictures::Image image = moment.updateAndDraw(*method);
    const auto covered = std::ranges::count_if(image.pixels, [](const glm::vec4& pixel) { return pixel.a > 0; });
    EXPECT_GT(covered, 0);
    EXPECT_LT(covered, static_cast<std::ptrdiff_t>(image.pixels.size()));
    for (const glm::vec4& pixel : image.pixels) EXPECT_LE(pixel.a, 1);
    EXPECT_EQ(method->primitives(), 2);
}

TEST(@CLASS@, DrawsTheSamePictureTwice) {
    TwoParticles moment;
    const auto method = prepared(moment);
    const pictures::Image first = moment.updateAndDraw(*method);
    EXPECT_EQ(moment.draw(*method).pixels, first.pixels);
}

}  // namespace
}  // namespace dustbench::@ID@
