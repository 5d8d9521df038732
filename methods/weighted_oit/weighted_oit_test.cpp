#include "methods/weighted_oit/weighted_oit.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "methods/kit/maths/transmittance.h"
#include "methods/kit/testing/test_moment.h"

namespace dustbench::weighted_oit {
namespace {

constexpr double wide = 6;  ///< reach of quads that cut nothing off

class Cloud : public TestMoment {
 public:
    explicit Cloud(std::size_t count, bool oneColour, std::uint32_t seed = 1)
        : TestMoment(count, 96, 72, {0, 2, 0}, {0.1, -0.15, -1}) {
        std::mt19937 random(seed);
        std::uniform_real_distribution<float> uniform(0, 1);
        dust.keepOneColour(oneColour);
        for (std::size_t i = 0; i < count; ++i) {
            dust.serial[i] = i;
            dust.x[i] = 12 * uniform(random) - 6;
            dust.y[i] = 4 * uniform(random);
            dust.z[i] = 3 - 30 * uniform(random);
            dust.radius[i] = 0.3f + uniform(random);
            dust.opacity[i] = 0.6f * uniform(random);
            dust.lifetime[i] = 5;
            if (oneColour) continue;
            dust.red[i] = uniform(random), dust.green[i] = uniform(random), dust.blue[i] = uniform(random);
        }
        dust.colourOfAll = {0.6f, 0.4f, 0.2f};
    }
    void place(std::size_t i, const glm::vec3& at, float radius, float opacity, const glm::vec3& colour) {
        dust.x[i] = at.x, dust.y[i] = at.y, dust.z[i] = at.z;
        dust.radius[i] = radius, dust.opacity[i] = opacity;
        dust.red[i] = colour.r, dust.green[i] = colour.g, dust.blue[i] = colour.b;
    }
    pictures::Image drawn(Weight weight) {
        WeightedOit method(weight, wide);
        method.prepare(scene, {}, device());
        return updateAndDraw(method);
    }
    /// One pixel's depth of one puff.
    [[nodiscard]] double depthOf(std::size_t i, const glm::dvec3& ray, double sceneMetres) const {
        const glm::dvec3 centre = glm::dvec3(dust.position(i)) - view.camera.eye;
        return maths::rayOpticalDepth(static_cast<double>(dust.opacity[i]), static_cast<double>(dust.radius[i]),
                                      glm::length(glm::cross(centre, ray)), glm::dot(centre, ray), 0, sceneMetres);
    }
    [[nodiscard]] double sceneAt(int x, int y, const glm::dvec3& ray) {
        const std::vector<float> depth = layer().sceneDepth().readFloats();
        const float reversed = depth[static_cast<std::size_t>((view.height - 1 - y) * view.width + x)];
        const glm::dvec3 ahead = glm::normalize(view.camera.target - view.camera.eye);
        return reversed > 0 ? view.camera.nearMetres / static_cast<double>(reversed) / glm::dot(ray, ahead)
                            : std::numeric_limits<double>::infinity();
    }
};

TEST(WeightedOit, IsExactForOneColour) {
    Cloud cloud(150, true);
    cloud.setGround(1.7);
    for (const auto& choice : weights.all()) {
        const pictures::Image image = cloud.drawn(choice.value);
        double most = 0;
        for (int y = 0; y < image.height; y += 5)
            for (int x = 0; x < image.width; x += 5) {
                const glm::dvec3 ray = cloud.view.rayDirection(x + 0.5, y + 0.5);
                const double scene = cloud.sceneAt(x, y, ray);
                double depth = 0;
                for (std::size_t i = 0; i < cloud.dust.size(); ++i) depth += cloud.depthOf(i, ray, scene);
                const double alpha = -std::expm1(-depth);
                most = std::max(most, alpha);
                ASSERT_NEAR(image.at(x, y).a, alpha, 2e-5) << choice.word << x << ' ' << y;
                for (int c = 0; c < 3; ++c)
                    ASSERT_NEAR(image.at(x, y)[c], alpha * static_cast<double>(cloud.dust.colourOfAll[c]), 2e-5);
            }
        EXPECT_GT(most, 0.5);
    }
}

/// Two puffs on the axis: the mean by the paper's Eq. 6, and hence its error against the ground truth.
TEST(WeightedOit, MixesTwoLayersByTheirWeightsAndErrsByTheClosedForm) {
    const glm::dvec3 red(1, 0, 0), blue(0, 0.2, 1);
    for (const auto& choice : weights.all())
        for (const bool redFirst : {true, false}) {
            Cloud square(2, false);
            const glm::vec3 ahead = glm::vec3(glm::normalize(square.view.camera.target - square.view.camera.eye));
            const std::array<double, 2> distance{redFirst ? 8.0 : 20.0, redFirst ? 20.0 : 8.0};
            square.place(0, square.at(static_cast<float>(distance[0]) * ahead), 1, 0.5f, red);
            square.place(1, square.at(static_cast<float>(distance[1]) * ahead), 1, 0.7f, blue);
            const pictures::Image image = square.drawn(choice.value);
            const int x = image.width / 2, y = image.height / 2;
            const glm::dvec3 ray = square.view.rayDirection(x + 0.5, y + 0.5);
            std::array<double, 2> alpha{}, weighted{};
            for (std::size_t i = 0; i < 2; ++i) {
                alpha[i] = -std::expm1(-square.depthOf(i, ray, 1e9));
                const double axis = glm::dot(glm::dvec3(square.dust.position(i)) - square.view.camera.eye, ray) *
                                    glm::dot(ray, glm::dvec3(ahead));
                weighted[i] = alpha[i] * plainWeight(choice.value, axis, alpha[i], square.view.camera.nearMetres);
            }
            const double cover = 1 - (1 - alpha[0]) * (1 - alpha[1]);
            const glm::dvec3 mixed = (weighted[0] * red + weighted[1] * blue) / (weighted[0] + weighted[1]) * cover;
            const glm::dvec3 exact = redFirst ? alpha[0] * red + (1 - alpha[0]) * alpha[1] * blue
                                              : alpha[1] * blue + (1 - alpha[1]) * alpha[0] * red;
            for (int c = 0; c < 3; ++c) {
                EXPECT_NEAR(image.at(x, y)[c], mixed[c], 2e-5) << choice.word;
                EXPECT_NEAR(static_cast<double>(image.at(x, y)[c]) - exact[c], mixed[c] - exact[c], 2e-5)
                    << choice.word;
            }
            EXPECT_GT(glm::length(mixed - exact), 0.02) << choice.word;
            EXPECT_NEAR(image.at(x, y).a, cover, 2e-5);
        }
}

TEST(WeightedOit, DoesNotDependOnTheOrder) {
    Cloud cloud(200, false, 3), reversed(200, false, 3);
    for (std::size_t i = 0; i < 200; ++i)
        reversed.place(i, cloud.dust.position(199 - i), cloud.dust.radius[199 - i], cloud.dust.opacity[199 - i],
                       cloud.dust.colour(199 - i));
    const pictures::Image a = cloud.drawn(Weight::eq7), b = reversed.drawn(Weight::eq7);
    for (std::size_t i = 0; i < a.pixels.size(); ++i)
        for (int c = 0; c < 4; ++c) ASSERT_NEAR(a.pixels[i][c], b.pixels[i][c], 1e-5f);
}

TEST(WeightedOit, DrawsTheSameAgainAndFollowsACloudThatComesAndGoes) {
    Cloud empty(0, false), few(20, false), one(30, true);
    const MethodInfo info = describe();
    const auto method = info.create(ParameterValues(info.parameters));
    method->prepare(few.scene, {}, Cloud::device());
    const pictures::Image first = few.updateAndDraw(*method);
    EXPECT_EQ(few.draw(*method).pixels, first.pixels);
    (void)one.updateAndDraw(*method);
    for (const glm::vec4& pixel : empty.updateAndDraw(*method).pixels) ASSERT_EQ(pixel, glm::vec4(0));
    EXPECT_EQ(method->primitives(), 0);
    EXPECT_EQ(few.updateAndDraw(*method).pixels, first.pixels);
    std::size_t sums = 0;
    for (const MemoryUse& use : method->memory())
        if (use.structure == "weighted sums") sums = use.gpuBytes;
    EXPECT_EQ(sums, 96u * 72u * 20u);
}

}  // namespace
}  // namespace dustbench::weighted_oit
