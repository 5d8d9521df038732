#include <gtest/gtest.h>

#include <cmath>

#include "methods/moment_oit/test_cloud.h"

namespace dustbench::moment_oit {
namespace {

std::vector<Settings> allSettings() {
    std::vector<Settings> all;
    for (const int moments : {4, 6})
        for (const Shape shape : {Shape::puff, Shape::point})
            for (const int samples : {1, 3})
                for (const Warp warp : {Warp::log, Warp::linear})
                    all.push_back({.kind = {.count = moments}, .shape = shape, .samples = samples, .warp = warp});
    return all;
}

TEST(MomentOit, DrawsWhatThePlainMomentsGive) {
    Cloud cloud(40, false, 2);
    cloud.setGround(1.8);
    for (Settings settings : allSettings())
        for (const double biasFactor : {1.0, 300.0}) {
            settings.biasFactor = biasFactor;
            const pictures::Image image = cloud.drawn(settings);
            double largest = 0, sum = 0, most = 0;
            int values = 0;
            for (int y = 0; y < image.height; y += 3)
                for (int x = 0; x < image.width; x += 3) {
                    const glm::dvec4 plain = cloud.plainPixel(x, y, settings);
                    for (int c = 0; c < 4; ++c, ++values) {
                        const double difference = std::abs(static_cast<double>(image.at(x, y)[c]) - plain[c]);
                        largest = std::max(largest, difference);
                        sum += difference;
                    }
                    most = std::max(most, plain.a);
                }
            // With the paper's bias, rounding to single precision is visible where a ray meets only a few puffs.
            EXPECT_LT(largest, biasFactor > 1 ? 1e-5 : 2e-4) << settings.kind.count;
            EXPECT_LT(sum / values, biasFactor > 1 ? 1e-6 : 3e-6);
            EXPECT_GT(most, 0.5);
        }
}

TEST(MomentOit, IsExactForOneColour) {
    Cloud cloud(80, true);
    cloud.setGround(1.7);
    for (const Settings& settings : allSettings()) {
        const pictures::Image image = cloud.drawn(settings);
        double most = 0;
        for (int y = 0; y < image.height; y += 3)
            for (int x = 0; x < image.width; x += 3) {
                const glm::dvec3 ray = cloud.view.rayDirection(x + 0.5, y + 0.5);
                double depth = 0;
                for (const RayPuff& puff : cloud.along(ray, cloud.sceneAt(x, y, ray))) depth += profileOf(puff).depth;
                const double alpha = -std::expm1(-depth);
                most = std::max(most, alpha);
                ASSERT_NEAR(image.at(x, y).a, alpha, 2e-5) << x << ' ' << y;
                for (int c = 0; c < 3; ++c)
                    ASSERT_NEAR(image.at(x, y)[c], alpha * static_cast<double>(cloud.dust.colourOfAll[c]), 2e-5);
            }
        EXPECT_GT(most, 0.5);
    }
}

/// Thin puffs of different colours on the axis: two with four moments, three with six.
TEST(MomentOit, BlendsAsManyLayersAsMomentsHoldTwiceAsTheOperatorOverDoes) {
    const std::vector<float> distances{6, 14, 31}, opacities{0.5f, 0.7f, 0.6f};
    const std::vector<glm::dvec3> colours{{1, 0.1, 0}, {0, 0.2, 1}, {0.1, 1, 0.3}};
    for (const int moments : {4, 6})
        for (const Shape shape : {Shape::puff, Shape::point})
            for (const std::size_t layers : {std::size_t{1}, static_cast<std::size_t>(moments) / 2}) {
                Cloud cloud(layers, false);
                const glm::vec3 ahead = glm::vec3(glm::normalize(cloud.view.camera.target - cloud.view.camera.eye));
                // In reverse, so that the drawing order does not help.
                for (std::size_t i = 0; i < layers; ++i)
                    cloud.place(layers - 1 - i, cloud.at(distances[i] * ahead), 0.25f * distances[i] / 6, opacities[i],
                                glm::vec3(colours[i]));
                // In front of a surface, not within it: T is continuous there if the surface has no effect.
                const bool isPoint = shape == Shape::point;
                const Settings settings{
                    .kind = {.count = moments}, .shape = shape, .overestimation = isPoint ? 0.0 : 0.5};
                const pictures::Image image = cloud.drawn(settings);
                const int x = image.width / 2, y = image.height / 2;
                const auto puffs = cloud.along(cloud.view.rayDirection(x + 0.5, y + 0.5), 1e9);
                glm::dvec3 over(0);
                double left = 1;
                for (std::size_t i = 0; i < layers; ++i) {
                    const double alpha = -std::expm1(-profileOf(puffs[layers - 1 - i]).depth);
                    over += left * alpha * colours[i];
                    left *= 1 - alpha;
                }
                for (int c = 0; c < 3; ++c)
                    EXPECT_NEAR(image.at(x, y)[c], over[c],
                                layers == 1 ? 2e-5
                                : isPoint   ? 0.01
                                            : 0.03)
                        << moments << layers << isPoint;
                EXPECT_NEAR(image.at(x, y).a, 1 - left, 2e-5);
            }
}

TEST(MomentOit, ComesCloserToTheExactPictureThanTheMeanOfColours) {
    Cloud cloud(60, false, 4);
    cloud.dust.keepOneColour(false);
    for (std::size_t i = 0; i < cloud.dust.size(); ++i) {  // red in front of blue
        cloud.dust.opacity[i] = 0.5f + 0.3f * cloud.dust.opacity[i];
        cloud.dust.red[i] = cloud.dust.z[i] > -12 ? 1.0f : 0.0f;
        cloud.dust.green[i] = 0.2f;
        cloud.dust.blue[i] = 1 - cloud.dust.red[i];
    }
    const pictures::Image six = cloud.drawn({}), four = cloud.drawn({.kind = {.count = 4}});
    double sixError = 0, fourError = 0, meanError = 0;
    for (int y = 0; y < six.height; y += 2)
        for (int x = 0; x < six.width; x += 2) {
            const auto puffs = cloud.along(cloud.view.rayDirection(x + 0.5, y + 0.5), 1e9);
            glm::dvec3 exact(0), all(0);
            double before = 0;
            for (double t = 0.0125; t < 45; t += 0.025) {
                double depth = 0;
                glm::dvec3 emitted(0);
                for (std::size_t i = 0; i < puffs.size(); ++i) {
                    const double s = puffs[i].deviationMetres, far = (t - puffs[i].footMetres) / s;
                    const double one =
                        puffs[i].whole / (std::sqrt(2 * 3.14159265358979) * s) * std::exp(-far * far / 2) * 0.025;
                    depth += one;
                    emitted += one * glm::dvec3(cloud.dust.colour(i));
                }
                exact += emitted * std::exp(-before - depth / 2);
                all += emitted;
                before += depth;
            }
            const double alpha = -std::expm1(-before);
            if (alpha < 1e-3) continue;
            sixError += std::abs(static_cast<double>(six.at(x, y).r) - exact.r);
            fourError += std::abs(static_cast<double>(four.at(x, y).r) - exact.r);
            meanError += std::abs(all.r / before * alpha - exact.r);
        }
    EXPECT_LT(fourError, 0.1 * meanError);
    EXPECT_LT(sixError, 0.1 * meanError);
}

TEST(MomentOit, DrawsTheSameAgainAndFollowsACloudThatComesAndGoes) {
    Cloud empty(0, false), few(20, false), one(30, true);
    const MethodInfo info = describe();
    const auto method = info.create(ParameterValues(info.parameters));
    method->prepare(few.scene, {}, Cloud::device());
    const pictures::Image first = few.updateAndDraw(*method);
    EXPECT_EQ(few.draw(*method).pixels, first.pixels);
    (void)one.updateAndDraw(*method);
    for (const glm::vec4& pixel : empty.updateAndDraw(*method).pixels) ASSERT_EQ(pixel, glm::vec4(0));
    EXPECT_EQ(few.updateAndDraw(*method).pixels, first.pixels);
    EXPECT_EQ(method->primitives(), 40);
    std::size_t bytes = 0;
    for (const MemoryUse& use : method->memory())
        if (use.structure != "puffs") bytes += use.gpuBytes;
    EXPECT_EQ(bytes, 48u * 36u * 48u);
}

}  // namespace
}  // namespace dustbench::moment_oit
