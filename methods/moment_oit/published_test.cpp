// The method as published: puffs as surfaces, every kind of moments, in floats and in 16 bits.
#include <gtest/gtest.h>

#include "methods/contract/errors.h"
#include "methods/moment_oit/test_cloud.h"

namespace dustbench::moment_oit {
namespace {

/// Puffs that overlap each other many times.
class DenseCloud : public Cloud {
 public:
    DenseCloud(std::size_t count, std::uint32_t seed) : Cloud(count, false, seed) {
        for (std::size_t i = 0; i < count; ++i) {
            dust.radius[i] *= 2.5f;
            dust.opacity[i] = 0.1f + 1.2f * dust.opacity[i];
        }
    }
};

/// Differences of a picture from others, pixel by pixel.
struct Differences {
    double largest = 0, sum = 0;
    int values = 0;
    void add(const glm::vec4& drawn, const glm::dvec4& other) {
        for (int c = 0; c < 4; ++c, ++values) {
            const double difference = std::abs(static_cast<double>(drawn[c]) - other[c]);
            largest = std::max(largest, std::isfinite(difference) ? difference : 1e9);
            sum += difference;
        }
    }
    [[nodiscard]] double mean() const { return sum / values; }
};

TEST(PublishedMomentOit, DrawsWhatThePlainMomentsGive) {
    DenseCloud cloud(40, 2);
    cloud.setGround(1.8);
    for (const Kind& kind : allKinds())
        for (const Puff puff : {Puff::surface, Puff::volume})
            for (const double bias : {0.0, 0.02}) {  // 0: the paper's
                const Settings settings{.kind = kind, .puff = puff, .biasFactor = bias > 0 ? bias / biasOf(kind) : 1};
                const pictures::Image image = cloud.drawn(settings);
                Differences differences;
                double most = 0;
                for (int y = 0; y < image.height; y += 5)
                    for (int x = 0; x < image.width; x += 3) {
                        const glm::dvec4 plain = cloud.plainPixel(x, y, settings);
                        if (plain.a < 1e-3) continue;
                        differences.add(image.at(x, y), plain);
                        most = std::max(most, plain.a);
                    }
                // Where a bit is rounded the other way, the paper's bias hides less of it than a large one.
                EXPECT_LT(differences.largest, bias > 0 ? 1e-4 : 6e-4) << nameOf(kind);
                EXPECT_LT(differences.mean(), bias > 0 ? 2e-6 : 8e-6) << nameOf(kind);
                EXPECT_GT(most, 0.9);
            }
}

TEST(PublishedMomentOit, ErrsLessWithMoreMoments) {
    for (const Basis basis : {Basis::power, Basis::trigonometric})
        for (const Precision precision : {Precision::single, Precision::quantised}) {
            double before = 1;
            for (const int count : {4, 6, 8}) {
                const Settings settings{
                    .kind = {basis, precision, count}, .puff = Puff::surface, .overestimation = 0.25};
                Differences differences;
                for (const std::uint32_t seed : {5u, 6u, 7u}) {
                    DenseCloud cloud(60, seed);
                    const pictures::Image image = cloud.drawn(settings);
                    for (int y = 0; y < image.height; y += 4)
                        for (int x = 0; x < image.width; x += 4)
                            differences.add(image.at(x, y), cloud.sortedSurfaces(x, y));
                }
                EXPECT_LT(differences.mean(), 0.92 * before) << nameOf(settings.kind);
                before = differences.mean();
            }
            EXPECT_LT(before, 6e-3);
        }
}

/// Puffs on the axis, half as many as numbers, drawn from far to near. In front of a surface, not within it: with
/// overestimation 0, a surface has no effect on itself.
TEST(PublishedMomentOit, BlendsHalfAsManySurfacesAsNumbersInExactOrder) {
    const std::vector<float> distances{4, 9, 18, 40};
    const std::vector<glm::vec3> colours{{1, 0.1, 0}, {0, 0.2, 1}, {0.1, 1, 0.3}, {0.9, 0.8, 0.1}};
    for (const Kind& kind : allKinds()) {
        const auto layers = static_cast<std::size_t>(kind.count) / 2;
        Cloud cloud(layers, false);
        const glm::vec3 ahead = glm::vec3(glm::normalize(cloud.view.camera.target - cloud.view.camera.eye));
        for (std::size_t i = 0; i < layers; ++i)
            cloud.place(layers - 1 - i, cloud.at(distances[i] * ahead), 0.3f * distances[i], 0.6f, colours[i]);
        const pictures::Image image = cloud.drawn({.kind = kind, .puff = Puff::surface, .overestimation = 0});
        const int x = image.width / 2, y = image.height / 2;
        const glm::dvec4 exact = cloud.sortedSurfaces(x, y);
        for (int c = 0; c < 3; ++c) EXPECT_NEAR(image.at(x, y)[c], exact[c], 0.01) << nameOf(kind);
        EXPECT_NEAR(image.at(x, y).a, exact.a, 2e-5) << nameOf(kind);
    }
}

TEST(PublishedMomentOit, KeepsTheTotalTransmittance) {
    DenseCloud cloud(80, 3);
    cloud.setGround(1.7);
    for (const Kind& kind : allKinds()) {
        const pictures::Image image =
            cloud.drawn({.kind = kind, .puff = Puff::surface, .biasFactor = 0.5 / biasOf(kind)});
        for (int y = 0; y < image.height; y += 3)
            for (int x = 0; x < image.width; x += 3)
                ASSERT_NEAR(image.at(x, y).a, cloud.sortedSurfaces(x, y).a, 2e-5) << nameOf(kind);
    }
}

TEST(PublishedMomentOit, DrawsTheSameAgainAfterOtherClouds) {
    DenseCloud few(20, 1), many(70, 2), one(1, 3);
    for (const Kind& kind : allKinds()) {
        MomentOit method({.kind = kind, .puff = Puff::surface});
        method.prepare(few.scene, {}, Cloud::device());
        const pictures::Image first = few.updateAndDraw(method);
        EXPECT_EQ(few.draw(method).pixels, first.pixels);
        (void)many.updateAndDraw(method);
        (void)one.updateAndDraw(method);
        EXPECT_EQ(few.updateAndDraw(method).pixels, first.pixels) << nameOf(kind);
    }
}

Facts factsOf(const Kind& kind) {
    static const MethodInfo info = describe();
    Cloud cloud(1, true);
    MomentOit method({.kind = kind});
    Facts facts(info.facts, FactOver::lastFrame);
    method.report(cloud.frame(), facts);
    return facts;
}

double bitsOf(const Kind& kind) {
    return std::get<double>(factsOf(kind).value("bits_per_pixel").value());
}

TEST(PublishedMomentOit, CountsTheBitsOfItsTargets) {
    EXPECT_EQ(bitsOf({Basis::power, Precision::single, 4}), 128 + 160);
    const auto bytesOf = [](const Kind& kind) {
        return std::get<std::int64_t>(factsOf(kind).value("bytes_per_fragment").value());
    };
    EXPECT_EQ(bytesOf({Basis::power, Precision::single, 4}), 3 * 20 + 2 * 16) << "moments are added to and read";
    EXPECT_EQ(bytesOf({Basis::power, Precision::quantised, 4}), 8 + 4 + 2 * 16) << "moments are only read";
    EXPECT_EQ(bitsOf({Basis::power, Precision::single, 6}), 128 + 256);
    EXPECT_EQ(bitsOf({Basis::trigonometric, Precision::single, 8}), 128 + 288);
    EXPECT_EQ(bitsOf({Basis::power, Precision::quantised, 4}), 128 + 96);
    EXPECT_EQ(bitsOf({Basis::trigonometric, Precision::quantised, 8}), 128 + 160);
}

TEST(PublishedMomentOit, IsWhatThePaperModeSelects) {
    ParameterValues values(describe().parameters);
    EXPECT_EQ(values.choice("puff"), "volume");
    EXPECT_EQ(values.real("overestimation"), 0.5);
    values.set("mode", "paper");
    EXPECT_EQ(values.choice("puff"), "surface");
    EXPECT_EQ(values.choice("warp"), "log");
    EXPECT_EQ(values.real("overestimation"), 0.25);
    EXPECT_EQ(values.real("bias_factor"), 1);
    values.set("precision", "quantised");
    values.set("moments", "8");
    values.set("bias_factor", "401");
    EXPECT_THROW((void)describe().create(values), InputError);
    values.set("bias_factor", "400");
    EXPECT_NE(describe().create(values), nullptr);
}

}  // namespace
}  // namespace dustbench::moment_oit
