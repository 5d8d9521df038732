#include "methods/stochastic_transparency/stochastic_transparency.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <random>

#include "methods/kit/maths/transmittance.h"
#include "methods/kit/testing/test_moment.h"

namespace dustbench::stochastic_transparency {
namespace {

constexpr double wide = 6;  ///< reach of quads that cut nothing off

/// A puff's surface at a pixel, from the closed form.
struct Seen {
    double nearness;
    double alpha;
    glm::dvec3 colour;
    std::uint32_t puff;
};

class Cloud : public TestMoment {
 public:
    explicit Cloud(std::size_t count, bool oneColour = false) : TestMoment(count, 48, 36, {0, 2, 0}, {0.1, -0.15, -1}) {
        std::mt19937 random(1);
        std::uniform_real_distribution<float> uniform(0, 1);
        dust.keepOneColour(oneColour);
        for (std::size_t i = 0; i < count; ++i) {
            dust.serial[i] = i;
            dust.x[i] = 8 * uniform(random) - 4;
            dust.y[i] = 4 * uniform(random);
            dust.z[i] = 2 - 16 * uniform(random);
            dust.radius[i] = 0.6f + 2 * uniform(random);
            dust.opacity[i] = 0.8f * uniform(random);
            dust.lifetime[i] = 5;
            if (oneColour) continue;
            dust.red[i] = uniform(random), dust.green[i] = uniform(random), dust.blue[i] = uniform(random);
        }
        dust.colourOfAll = {0.6f, 0.4f, 0.2f};
        setGround(1.7);
    }
    pictures::Image drawn(Settings settings, std::uint64_t seed = 1) {
        settings.reachDeviations = wide;
        StochasticTransparency method(settings);
        RunSetup setup;
        setup.seed = seed;
        method.prepare(scene, setup, device());
        return updateAndDraw(method);
    }
    [[nodiscard]] std::vector<Seen> seenAt(int x, int y, Puff kind) {
        if (reversed_.empty()) reversed_ = layer().sceneDepth().readFloats();
        const auto hidden = static_cast<double>(reversed_[pixelOf(x, y)]);
        const glm::dvec3 ray = view.rayDirection(x + 0.5, y + 0.5);
        const glm::dvec3 ahead = glm::normalize(view.camera.target - view.camera.eye);
        const double near = view.camera.nearMetres, infinity = std::numeric_limits<double>::infinity();
        const double limit = hidden > 0 ? near / hidden / glm::dot(ray, ahead) : infinity;
        std::vector<Seen> seen;
        for (std::size_t i = 0; i < dust.size(); ++i) {
            const glm::dvec3 centre = glm::dvec3(dust.position(i)) - view.camera.eye;
            const double z = glm::dot(centre, ahead), foot = glm::dot(centre, ray);
            const bool surface = kind == Puff::surface;
            if (surface && (z <= near || near / z < hidden)) continue;
            const double depth = maths::rayOpticalDepth(
                static_cast<double>(dust.opacity[i]), static_cast<double>(dust.radius[i]),
                glm::length(glm::cross(centre, ray)), foot, surface ? -infinity : 0.0, surface ? infinity : limit);
            const double nearness = surface ? near / z : near / std::clamp(foot, near, limit) / glm::dot(ray, ahead);
            const glm::dvec3 colour(dust.colour(i));
            seen.push_back({nearness, -std::expm1(-depth), colour, static_cast<std::uint32_t>(i)});
        }
        return seen;
    }
    [[nodiscard]] std::size_t pixelOf(int x, int y) const {
        return static_cast<std::size_t>((view.height - 1 - y) * view.width + x);
    }
    /// Surfaces composited from front to back.
    [[nodiscard]] glm::dvec4 sortedAt(int x, int y, Puff kind = Puff::surface) {
        std::vector<Seen> seen = seenAt(x, y, kind);
        std::ranges::sort(seen, std::ranges::greater{}, &Seen::nearness);
        glm::dvec4 sum(0);
        for (const Seen& s : seen) sum += (1 - sum.a) * s.alpha * glm::dvec4(s.colour, 1);
        return sum;
    }
    /// Plain samples: every sample keeps its nearest surface.
    [[nodiscard]] glm::dvec4 plainAt(int x, int y, const Settings& settings, std::uint64_t seed) {
        const std::vector<Seen> seen = seenAt(x, y, settings.puff);
        std::vector<double> nearest(static_cast<std::size_t>(settings.samples), 0);
        const auto pixel = static_cast<std::uint32_t>(pixelOf(x, y));
        for (const Seen& s : seen) {
            const std::uint64_t mask = plainMask(settings, seed, pixel, s.puff, static_cast<float>(s.alpha));
            for (std::size_t i = 0; i < nearest.size(); ++i)
                if (mask >> i & 1) nearest[i] = std::max(nearest[i], s.nearness);
        }
        glm::dvec4 sum(0);
        double through = 1;
        for (const Seen& s : seen) {
            const auto visible = std::ranges::count_if(nearest, [&](double other) { return s.nearness >= other; });
            sum += static_cast<double>(visible) / settings.samples * s.alpha * glm::dvec4(s.colour, 1);
            through *= 1 - s.alpha;
        }
        return settings.alphaCorrection && sum.a > 0 ? sum * ((1 - through) / sum.a) : sum;
    }

 private:
    std::vector<float> reversed_;
};

double squaredError(const glm::vec4& a, const glm::dvec4& b) {
    const glm::dvec4 difference = glm::dvec4(a) - b;
    return glm::dot(difference, difference);
}

/// Root mean square over pixels and seeds, against sorted surfaces.
double errorOf(Cloud& cloud, const Settings& settings, std::uint64_t seeds) {
    double sum = 0;
    int count = 0;
    for (std::uint64_t seed = 1; seed <= seeds; ++seed) {
        const pictures::Image image = cloud.drawn(settings, seed);
        for (int y = 0; y < image.height; y += 4)
            for (int x = 0; x < image.width; x += 4, ++count) sum += squaredError(image.at(x, y), cloud.sortedAt(x, y));
    }
    return std::sqrt(sum / count);
}

/// Rounding may change the samples of a few pixels, but of no more.
TEST(StochasticTransparency, IsThePictureOfPlainSamples) {
    Cloud cloud(25);
    for (const Puff puff : {Puff::surface, Puff::volume})
        for (const int samples : {1, 8, 33, 64})
            for (const bool stratified : {false, true})
                for (const bool corrected : {false, true}) {
                    const Settings settings{samples, stratified, corrected, puff, wide};
                    const std::uint64_t seed = 0x9000000080000001u;
                    const pictures::Image image = cloud.drawn(settings, seed);
                    int differ = 0, count = 0;
                    for (int y = 0; y < image.height; y += 3)
                        for (int x = 0; x < image.width; x += 3, ++count)
                            differ += squaredError(image.at(x, y), cloud.plainAt(x, y, settings, seed)) > 1e-8;
                    EXPECT_LE(differ, count / 50) << samples << stratified << corrected;
                }
}

TEST(StochasticTransparency, HasTheExactAlphaWithCorrectionAndTheExactPictureOfOneColour) {
    Cloud colours(40), one(40, true);
    for (const int samples : {1, 8}) {
        const pictures::Image several = colours.drawn({.samples = samples}), single = one.drawn({.samples = samples});
        double most = 0;
        for (int y = 0; y < several.height; y += 3)
            for (int x = 0; x < several.width; x += 3) {
                ASSERT_NEAR(several.at(x, y).a, colours.sortedAt(x, y).a, 2e-5) << x << ' ' << y;
                ASSERT_LT(squaredError(single.at(x, y), one.sortedAt(x, y)), 1e-9) << x << ' ' << y;
                most = std::max(most, colours.sortedAt(x, y).a);
            }
        EXPECT_GT(most, 0.9);
    }
}

/// χ² of the pixels' mean errors, in units of their standard errors: 1 on average, whatever the noise.
TEST(StochasticTransparency, IsUnbiasedWithoutCorrection) {
    Cloud cloud(25);
    constexpr int seeds = 64;
    for (const bool stratified : {false, true}) {
        std::vector<glm::dvec4> sum(48 * 36, glm::dvec4(0)), squares = sum;
        for (std::uint64_t seed = 1; seed <= seeds; ++seed) {
            const pictures::Image image =
                cloud.drawn({.samples = 4, .stratified = stratified, .alphaCorrection = false}, seed);
            for (std::size_t i = 0; i < sum.size(); ++i) {
                const glm::dvec4 value(image.pixels[i]);
                sum[i] += value, squares[i] += value * value;
            }
        }
        double chi = 0, signedSum = 0;
        int count = 0;
        for (int y = 0; y < 36; ++y)
            for (int x = 0; x < 48; ++x) {
                const auto i = static_cast<std::size_t>(y * 48 + x);
                const double mean = sum[i].a / seeds, variance = (squares[i].a / seeds - mean * mean) / (seeds - 1);
                if (variance < 1e-6) continue;
                const double error = (mean - cloud.sortedAt(x, y).a) / std::sqrt(variance);
                chi += error * error, signedSum += error, ++count;
            }
        ASSERT_GT(count, 300);
        EXPECT_NEAR(chi / count, 1, 0.25) << stratified;
        EXPECT_NEAR(signedSum / count, 0, 4 / std::sqrt(count)) << stratified;
    }
}

TEST(StochasticTransparency, HasAnErrorThatFallsWithTheRootOfTheSamples) {
    Cloud cloud(25);
    for (const bool corrected : {false, true})
        for (const bool stratified : {false, true}) {
            const Settings few{4, stratified, corrected}, many{64, stratified, corrected};
            const double order = std::log(errorOf(cloud, few, 12) / errorOf(cloud, many, 12)) / std::log(16.0);
            // A stratified share of one surface has an error of order 1; a random set's overlaps, ½.
            EXPECT_GT(order, 0.44) << corrected << stratified;
            EXPECT_LT(order, stratified ? 0.75 : 0.56) << corrected << stratified;
        }
    const Settings scattered{8, false, false}, stratified{8, true, false}, corrected{8, true, true};
    const double worst = errorOf(cloud, scattered, 12), better = errorOf(cloud, stratified, 12);
    EXPECT_LT(better, worst);
    EXPECT_LT(errorOf(cloud, corrected, 12), better);
}

TEST(StochasticTransparency, CoversAStratifiedShareOfTheSamples) {
    for (const float alpha : {0.0f, 0.13f, 0.5f, 0.99f, 1.0f}) {
        double mean = 0;
        for (std::uint32_t pixel = 0; pixel < 4000; ++pixel) {
            const double wanted = static_cast<double>(alpha) * 11;
            const int covered = std::popcount(plainMask({.samples = 11}, 3, pixel, 5, alpha));
            EXPECT_LT(std::abs(covered - wanted), 1);
            mean += covered / 11.0 / 4000;
        }
        EXPECT_NEAR(mean, alpha, 4 * 0.5 / 11 / std::sqrt(4000.0) + 1e-7);
    }
}

TEST(StochasticTransparency, DrawsTheSameAgainAndFollowsACloudThatComesAndGoes) {
    Cloud empty(0), few(20), one(30, true);
    const MethodInfo info = describe();
    const auto method = info.create(ParameterValues(info.parameters));
    method->prepare(few.scene, {}, Cloud::device());
    const pictures::Image first = few.updateAndDraw(*method);
    EXPECT_EQ(few.draw(*method).pixels, first.pixels);
    (void)one.updateAndDraw(*method);
    for (const glm::vec4& pixel : empty.updateAndDraw(*method).pixels) ASSERT_EQ(pixel, glm::vec4(0));
    EXPECT_EQ(few.updateAndDraw(*method).pixels, first.pixels);
    EXPECT_NE(few.drawn({}, 2).pixels, few.drawn({}, 1).pixels);
    Facts facts(info.facts, FactOver::lastFrame);
    method->report(few.frame(), facts);
    EXPECT_EQ(std::get<std::int64_t>(facts.value("bits_per_pixel").value()), 8 * 32 + 160);
    EXPECT_EQ(std::get<std::int64_t>(facts.value("bytes_per_fragment").value()), 3 * 8 * 4 + 2 * 20);
    std::size_t bytes = 0;
    for (const MemoryUse& use : method->memory())
        if (use.structure != "puffs") bytes += use.gpuBytes;
    EXPECT_EQ(bytes * 8, 48u * 36u * (8 * 32 + 160));
}

}  // namespace
}  // namespace dustbench::stochastic_transparency
