#include "methods/wavelet_oit/wavelet_oit.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <numeric>
#include <random>

#include "methods/kit/maths/transmittance.h"
#include "methods/kit/testing/test_moment.h"

namespace dustbench::wavelet_oit {
namespace {

constexpr double leastDepth = 1e-5;  ///< of the puffs that bounds of a pixel span, as in the shader

/// A puff on a pixel's ray.
struct OnRay {
    double depth, metres;
    double whole, foot, deviation, sceneMetres;
    glm::dvec3 colour;
};

class Cloud : public TestMoment {
 public:
    explicit Cloud(std::size_t count, std::uint32_t seed = 1, bool oneColour = false)
        : TestMoment(count, 48, 36, {0, 2, 0}, {0.1, -0.15, -1}) {
        std::mt19937 random(seed);
        std::uniform_real_distribution<float> uniform(0, 1);
        dust.keepOneColour(oneColour);
        for (std::size_t i = 0; i < count; ++i) {
            dust.serial[i] = i;
            dust.x[i] = 10 * uniform(random) - 5;
            dust.y[i] = 4 * uniform(random);
            dust.z[i] = 2 - 26 * uniform(random);
            dust.radius[i] = 0.4f + uniform(random);
            dust.opacity[i] = 0.7f * uniform(random);
            dust.lifetime[i] = 5;
            if (oneColour) continue;
            dust.red[i] = uniform(random), dust.green[i] = uniform(random), dust.blue[i] = uniform(random);
        }
        dust.colourOfAll = {0.6f, 0.4f, 0.2f};
    }
    void place(std::size_t i, const glm::vec3& at, float radius, float opacity) {
        dust.x[i] = at.x, dust.y[i] = at.y, dust.z[i] = at.z;
        dust.radius[i] = radius, dust.opacity[i] = opacity;
    }
    void shuffle(std::uint32_t seed) {
        std::vector<std::size_t> order(dust.size());
        std::iota(order.begin(), order.end(), std::size_t{0});
        std::ranges::shuffle(order, std::mt19937(seed));
        const auto reorder = [&](auto& values) {
            const std::vector<std::ranges::range_value_t<decltype(values)>> old(values.begin(), values.end());
            for (std::size_t i = 0; i < order.size(); ++i) values[i] = old[order[i]];
        };
        for (auto* values :
             {&dust.x, &dust.y, &dust.z, &dust.radius, &dust.opacity, &dust.red, &dust.green, &dust.blue})
            reorder(*values);
    }
    pictures::Image drawn(Settings settings) {
        settings.reachDeviations = 6;  // cuts off nothing
        method_.emplace(settings);
        targets_.clear();
        method_->prepare(scene, {}, device());
        return updateAndDraw(*method_);
    }
    /// Coefficients of the last picture at a pixel.
    [[nodiscard]] std::vector<double> drawnCoefficients(int x, int y, int rank) {
        std::vector<double> sums;
        for (std::size_t target = 0; target < (std::size_t{2} << rank) / 4; ++target) {
            if (targets_.size() <= target) targets_.push_back(method_->coefficients().texture(target).readFloats());
            for (std::size_t c = 0; c < 4; ++c)
                sums.push_back(static_cast<double>(targets_[target][4 * pixelOf(x, y) + c]));
        }
        return sums;
    }

    [[nodiscard]] std::vector<OnRay> along(int x, int y, Puff kind) {
        if (reversed_.empty()) reversed_ = layer().sceneDepth().readFloats();
        const auto reversed = static_cast<double>(reversed_[pixelOf(x, y)]);
        const glm::dvec3 ray = view.rayDirection(x + 0.5, y + 0.5);
        const glm::dvec3 ahead = glm::normalize(view.camera.target - view.camera.eye);
        const double cosine = glm::dot(ray, ahead), near = view.camera.nearMetres;
        const double sceneMetres = reversed > 0 ? near / reversed / cosine : 1e9;
        std::vector<OnRay> found;
        for (std::size_t i = 0; i < dust.size(); ++i) {
            const glm::dvec3 centre = glm::dvec3(dust.position(i)) - view.camera.eye;
            const double opacity = static_cast<double>(dust.opacity[i]), radius = static_cast<double>(dust.radius[i]);
            const double s = maths::puffDeviationMetres(radius), b = glm::length(glm::cross(centre, ray));
            const double foot = glm::dot(centre, ray), axis = glm::dot(centre, ahead);
            const double whole = maths::puffOpticalDepth(opacity) * std::exp(-b * b / (2 * s * s));
            OnRay one{whole, axis, whole, foot, s, sceneMetres, glm::dvec3(dust.colour(i))};
            if (kind == Puff::volume) {
                one.depth = maths::rayOpticalDepth(opacity, radius, b, foot, 0, sceneMetres);
                one.metres = std::clamp(foot, near, std::max(sceneMetres, near));
            } else if (axis <= near || axis > sceneMetres * cosine) {
                continue;
            }
            if (one.depth > 0) found.push_back(one);
        }
        return found;
    }
    [[nodiscard]] std::vector<Part> partsOf(const std::vector<OnRay>& puffs, const Settings& settings) const {
        MappedDepth range = depthRange(dust, view, settings);
        if (settings.bounds == Bounds::pixel) {
            range.nearestMetres = 1e9, range.farthestMetres = 0;
            for (const OnRay& puff : puffs) {
                if (puff.depth <= leastDepth) continue;
                range.nearestMetres = std::min(range.nearestMetres, puff.metres);
                range.farthestMetres = std::max(range.farthestMetres, puff.metres);
            }
            range.farthestMetres = std::max(range.farthestMetres, 1.001 * range.nearestMetres);
        }
        std::vector<Part> parts;
        for (const OnRay& puff : puffs) {
            const double at = range.at(puff.metres), slope = range.slopeAt(puff.metres);
            const double unit = std::numbers::sqrt2 * puff.deviation;
            Part part{puff.depth, std::clamp(at, 0.0, 1.0)};
            if (settings.puff == Puff::volume) {
                part.centre = at - (puff.metres - puff.foot) * slope;
                part.width = unit * slope;
                part.whole = puff.whole;
                part.begin = std::clamp(-puff.foot / unit, -6.0, 6.0);
                part.end = std::clamp((puff.sceneMetres - puff.foot) / unit, -6.0, 6.0);
            }
            parts.push_back(part);
        }
        return parts;
    }
    [[nodiscard]] std::vector<double> plainCoefficients(const std::vector<Part>& parts, int rank) const {
        std::vector<double> sums(std::size_t{2} << rank);
        for (const Part& part : parts) {
            const std::vector<double> one = coefficientsOf(part, rank);
            for (std::size_t i = 0; i < sums.size(); ++i) sums[i] += one[i];
        }
        return sums;
    }
    /// A pixel's colour by the plain wavelets.
    glm::dvec4 plainPixel(int x, int y, const Settings& settings) {
        const std::vector<OnRay> puffs = along(x, y, settings.puff);
        const std::vector<Part> parts = partsOf(puffs, settings);
        const std::vector<double> sums = plainCoefficients(parts, settings.rank);
        glm::dvec4 colours(0);
        double depth = 0;
        for (std::size_t i = 0; i < parts.size(); ++i) {
            const double weight = -std::expm1(-parts[i].depth) * std::exp(-depthBefore(sums, parts[i]));
            colours += weight * glm::dvec4(puffs[i].colour, 1);
            depth += parts[i].depth;
        }
        return colours.a > 0 ? colours / colours.a * -std::expm1(-depth) : glm::dvec4(0);
    }
    /// Surfaces composited from front to back.
    glm::dvec4 sortedPixel(int x, int y) {
        std::vector<OnRay> puffs = along(x, y, Puff::surface);
        std::ranges::sort(puffs, {}, &OnRay::metres);
        glm::dvec4 sum(0);
        for (const OnRay& puff : puffs) sum += (1 - sum.a) * -std::expm1(-puff.depth) * glm::dvec4(puff.colour, 1);
        return sum;
    }
    /// Whether rounding may change which puffs the bounds of the pixel span.
    bool isAmbiguous(int x, int y, const Settings& settings) {
        return settings.bounds == Bounds::pixel && std::ranges::any_of(along(x, y, settings.puff), [](const OnRay& p) {
                   return p.depth > 0.9 * leastDepth && p.depth < 1.1 * leastDepth;
               });
    }

 private:
    [[nodiscard]] std::size_t pixelOf(int x, int y) const {
        return static_cast<std::size_t>((view.height - 1 - y) * view.width + x);
    }
    std::optional<WaveletOit> method_;
    std::vector<float> reversed_;
    std::vector<std::vector<float>> targets_;
};

std::vector<Settings> allSettings(const std::vector<int>& ranks) {
    std::vector<Settings> all;
    for (const int rank : ranks)
        for (const Puff puff : {Puff::surface, Puff::volume})
            for (const Warp warp : {Warp::log, Warp::linear})
                for (const Bounds bounds : {Bounds::frame, Bounds::pixel})
                    all.push_back({.rank = rank, .puff = puff, .warp = warp, .bounds = bounds});
    return all;
}

TEST(WaveletOit, HasThePlainCoefficientsAndTheirPicture) {
    Cloud cloud(40, 2);
    cloud.setGround(1.8);
    for (const Settings& settings : allSettings({2, 3, 4})) {
        const pictures::Image image = cloud.drawn(settings);
        int pixels = 0, ambiguous = 0;
        double most = 0;
        for (int y = 0; y < image.height; y += 3)
            for (int x = 0; x < image.width; x += 3, ++pixels) {
                const bool skipped = cloud.isAmbiguous(x, y, settings);
                ambiguous += skipped;
                if (skipped) continue;
                const auto puffs = cloud.along(x, y, settings.puff);
                const auto plain = cloud.plainCoefficients(cloud.partsOf(puffs, settings), settings.rank);
                const auto drawn = cloud.drawnCoefficients(x, y, settings.rank);
                for (std::size_t i = 0; i < plain.size(); ++i) ASSERT_NEAR(drawn[i], plain[i], 5e-5) << i;
                const glm::dvec4 pixel = cloud.plainPixel(x, y, settings);
                for (int c = 0; c < 4; ++c) ASSERT_NEAR(image.at(x, y)[c], pixel[c], 1e-4) << settings.rank;
                most = std::max(most, pixel.a);
            }
        EXPECT_GT(most, 0.6);
        EXPECT_LT(ambiguous, pixels / 4);
    }
}

TEST(WaveletOit, HasTheTotalOpticalDepthInItsCoefficientsAtEveryRank) {
    Cloud cloud(60, 3);
    for (const Settings& settings : allSettings({2, 3, 4})) {
        if (settings.puff == Puff::volume) continue;
        (void)cloud.drawn(settings);
        double most = 0;
        for (int y = 0; y < cloud.view.height; y += 4)
            for (int x = 0; x < cloud.view.width; x += 4) {
                double total = 0;
                for (const OnRay& puff : cloud.along(x, y, Puff::surface)) total += puff.depth;
                const std::vector<double> sums = cloud.drawnCoefficients(x, y, settings.rank);
                ASSERT_NEAR(meanOver(sums, sums.size() - 1), total, 2e-5 * (1 + total)) << settings.rank;
                most = std::max(most, total);
            }
        EXPECT_GT(most, 1.5);
    }
}

TEST(WaveletOit, IsExactForOneColourAndForOnePuff) {
    for (const std::size_t count : {std::size_t{80}, std::size_t{1}}) {
        Cloud cloud(count, 1, count > 1);
        if (count == 1) cloud.place(0, cloud.at({0, -0.4f, -5}), 1.5f, 0.8f);
        cloud.setGround(1.7);
        for (const Settings& settings : allSettings({count > 1 ? 2 : 3})) {
            const pictures::Image image = cloud.drawn(settings);
            const glm::dvec3 colour(cloud.dust.colour(0));
            double most = 0;
            for (int y = 0; y < image.height; y += 3)
                for (int x = 0; x < image.width; x += 3) {
                    double depth = 0;
                    for (const OnRay& puff : cloud.along(x, y, settings.puff)) depth += puff.depth;
                    const double alpha = -std::expm1(-depth);
                    most = std::max(most, alpha);
                    ASSERT_NEAR(image.at(x, y).a, alpha, 2e-5) << x << ' ' << y;
                    for (int c = 0; c < 3; ++c) ASSERT_NEAR(image.at(x, y)[c], alpha * colour[c], 2e-5);
                }
            EXPECT_GT(most, 0.5);
        }
    }
}

/// Nine puffs, two cells apart at rank 3: exact with as many cells or more, not with half of them.
TEST(WaveletOit, IsExactForPuffsWithCellsOfTheirOwn) {
    Cloud cloud(9);
    const glm::vec3 ahead = glm::vec3(glm::normalize(cloud.view.camera.target - cloud.view.camera.eye));
    for (std::size_t i = 0; i < 9; ++i)
        cloud.place((5 * i) % 9, cloud.at(4 * std::pow(8.0f, static_cast<float>(i) / 8) * ahead), 3, 0.3f);
    const int x = cloud.view.width / 2, y = cloud.view.height / 2;
    const glm::dvec4 exact = cloud.sortedPixel(x, y);
    const auto errorWith = [&](int rank, Bounds bounds) {
        return glm::length(glm::dvec4(cloud.drawn({.rank = rank, .bounds = bounds}).at(x, y)) - exact);
    };
    for (const Bounds bounds : {Bounds::frame, Bounds::pixel}) {
        EXPECT_GT(errorWith(2, bounds), 1e-3);
        EXPECT_LT(errorWith(3, bounds), 5e-5);
        EXPECT_LT(errorWith(4, bounds), 5e-5);
    }
}

double errorOf(Cloud& cloud, const Settings& settings) {
    const pictures::Image image = cloud.drawn(settings);
    double squares = 0;
    int count = 0;
    for (int y = 0; y < image.height; y += 2)
        for (int x = 0; x < image.width; x += 2, ++count) {
            const glm::dvec4 difference = glm::dvec4(image.at(x, y)) - cloud.sortedPixel(x, y);
            squares += glm::dot(difference, difference);
        }
    return std::sqrt(squares / count);
}

TEST(WaveletOit, ErrsLessWithAHigherRankAndWithBoundsOfThePixel) {
    std::map<Bounds, std::map<int, double>> error;
    for (const std::uint32_t seed : {1u, 2u, 3u}) {
        Cloud cloud(300, seed);
        cloud.setGround(1.8);
        for (const Bounds bounds : {Bounds::frame, Bounds::pixel})
            for (const int rank : {2, 3, 4})
                error[bounds][rank] += errorOf(cloud, {.rank = rank, .bounds = bounds}) / 3;
    }
    for (auto& [bounds, of] : error) {
        EXPECT_LT(of[3], 0.8 * of[2]);
        EXPECT_LT(of[4], 0.8 * of[3]);
    }
    for (const int rank : {2, 3, 4}) EXPECT_LT(error[Bounds::pixel][rank], error[Bounds::frame][rank]);
}

TEST(WaveletOit, DrawsTheSamePictureInAnyOrderOfThePuffs) {
    for (const Puff puff : {Puff::surface, Puff::volume}) {
        Cloud cloud(150, 4);
        const pictures::Image first = cloud.drawn({.puff = puff});
        for (const std::uint32_t seed : {1u, 2u}) {
            cloud.shuffle(seed);
            const pictures::Image other = cloud.drawn({.puff = puff});
            for (std::size_t i = 0; i < first.pixels.size(); ++i)
                for (int c = 0; c < 4; ++c) ASSERT_NEAR(first.pixels[i][c], other.pixels[i][c], 2e-5);
        }
    }
}

/// Adding n non-negative numbers in half floats errs by n·2⁻¹⁰ of their sum at most, whether a driver rounds or cuts.
TEST(WaveletOit, PackedStaysWithinTheRoundingOfHalfFloats) {
    Cloud cloud(60, 5);
    for (const int rank : {2, 3, 4}) {
        const Settings exact{.rank = rank}, packed{.rank = rank, .storage = Storage::halves};
        const pictures::Image singles = cloud.drawn(exact), halves = cloud.drawn(packed);
        double largest = 0;
        for (int y = 0; y < halves.height; y += 3)
            for (int x = 0; x < halves.width; x += 3) {
                const auto puffs = cloud.along(x, y, Puff::surface);
                const auto plain = cloud.plainCoefficients(cloud.partsOf(puffs, packed), rank);
                const auto drawn = cloud.drawnCoefficients(x, y, rank);
                const double relative = std::ldexp(static_cast<double>(puffs.size()), -10);
                const double least = std::ldexp(static_cast<double>(puffs.size()), -24);  // subnormal
                double change = 0;                                                        // of A
                for (std::size_t i = 0; i < plain.size(); ++i) {
                    const double bound = relative * plain[i] + least + 1e-6;
                    ASSERT_NEAR(drawn[i], plain[i], bound) << rank << ' ' << i;
                    change += 2 * std::exp2(rank / 2.0) * std::abs(drawn[i] - plain[i]);
                }
                ASSERT_NEAR(halves.at(x, y).a, singles.at(x, y).a, 1e-6);  // from the sum of depths
                for (int c = 0; c < 3; ++c) {
                    const double difference = std::abs(static_cast<double>(halves.at(x, y)[c] - singles.at(x, y)[c]));
                    ASSERT_LT(difference, 2 * std::expm1(change) + 1e-5);
                    largest = std::max(largest, difference);
                }
            }
        EXPECT_LT(largest, 5e-3) << rank;
        EXPECT_GT(largest, 1e-6) << rank;  // otherwise nothing is packed
    }
}

/// Against a fine march of the puffs' extinction.
TEST(WaveletOit, VolumesComeCloserThanSurfacesToPuffsThatIntersect) {
    Cloud cloud(60, 6);
    const pictures::Image volumes = cloud.drawn({.puff = Puff::volume, .bounds = Bounds::pixel});
    const pictures::Image surfaces = cloud.drawn({.puff = Puff::surface, .bounds = Bounds::pixel});
    double volumeError = 0, surfaceError = 0;
    for (int y = 0; y < volumes.height; y += 4)
        for (int x = 0; x < volumes.width; x += 4) {
            const auto puffs = cloud.along(x, y, Puff::volume);
            glm::dvec4 exact(0);  // α: depth
            for (double t = 0.0125; t < 35; t += 0.025) {
                glm::dvec4 step(0);
                for (const OnRay& puff : puffs) {
                    const double far = (t - puff.foot) / puff.deviation;
                    step += puff.whole / (std::sqrt(2 * std::numbers::pi) * puff.deviation) * std::exp(-far * far / 2) *
                            0.025 * glm::dvec4(puff.colour, 1);
                }
                exact += glm::dvec4(std::exp(-exact.a - step.a / 2) * glm::dvec3(step), step.a);
            }
            volumeError += glm::length(glm::dvec3(volumes.at(x, y)) - glm::dvec3(exact));
            surfaceError += glm::length(glm::dvec3(surfaces.at(x, y)) - glm::dvec3(exact));
        }
    EXPECT_LT(volumeError, 0.8 * surfaceError);
}

TEST(WaveletOit, DrawsTheSameAgainAndFollowsACloudThatComesAndGoes) {
    Cloud empty(0), few(20), one(30, 1, true);
    const MethodInfo info = describe();
    for (const auto& choice : boundKinds.all()) {
        ParameterValues values(info.parameters);
        values.set("bounds", std::string(choice.word));
        const auto method = info.create(values);
        method->prepare(few.scene, {}, Cloud::device());
        const pictures::Image first = few.updateAndDraw(*method);
        EXPECT_EQ(few.draw(*method).pixels, first.pixels);
        (void)one.updateAndDraw(*method);
        for (const glm::vec4& pixel : empty.updateAndDraw(*method).pixels) ASSERT_EQ(pixel, glm::vec4(0));
        EXPECT_EQ(few.updateAndDraw(*method).pixels, first.pixels);
        const bool pixel = choice.value == Bounds::pixel;
        EXPECT_EQ(method->primitives(), pixel ? 60 : 40);
        Facts facts(info.facts, FactOver::lastFrame);
        method->report(few.frame(), facts);
        const std::int64_t bits = 16 * 32 + 160 + (pixel ? 64 : 0);
        EXPECT_EQ(std::get<std::int64_t>(facts.value("bits_per_pixel").value()), bits);
        EXPECT_EQ(std::get<std::int64_t>(facts.value("bytes_per_fragment").value()),
                  3 * 64 + 2 * 20 + (pixel ? 32 : 0));
        std::size_t bytes = 0;
        for (const MemoryUse& use : method->memory())
            if (use.structure != "puffs") bytes += use.gpuBytes;
        EXPECT_EQ(8 * bytes, 48u * 36u * static_cast<std::size_t>(bits));
    }
}

}  // namespace
}  // namespace dustbench::wavelet_oit
