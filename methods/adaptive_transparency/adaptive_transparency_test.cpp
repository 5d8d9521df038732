#include "methods/adaptive_transparency/adaptive_transparency.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "methods/adaptive_transparency/plain_visibility.h"
#include "methods/kit/maths/transmittance.h"
#include "methods/kit/testing/test_moment.h"

namespace dustbench::adaptive_transparency {
namespace {

constexpr double wide = 6;           ///< reach that cuts nothing off
constexpr double leastAlpha = 1e-5;  ///< of a fragment, as in the shader

struct Fragment {
    double depth, alpha;
    glm::dvec3 colour;
    std::size_t puff;
};
using Fragments = std::vector<Fragment>;

/// Puffs of several colours that intersect each other, around the eye and in front of it.
class Cloud : public TestMoment {
 public:
    explicit Cloud(std::size_t count, std::uint32_t seed = 1) : TestMoment(count, 93, 70, {0, 2, 0}, {0.1, -0.15, -1}) {
        std::mt19937 random(seed);
        std::uniform_real_distribution<float> uniform(0, 1);
        dust.keepOneColour(false);
        for (std::size_t i = 0; i < count; ++i) {
            dust.serial[i] = i;
            dust.x[i] = 12 * uniform(random) - 6;
            dust.y[i] = 4 * uniform(random);
            dust.z[i] = 3 - 30 * uniform(random);
            dust.radius[i] = 0.3f + uniform(random);
            dust.opacity[i] = 0.8f * uniform(random);
            dust.lifetime[i] = 5;
            dust.red[i] = uniform(random), dust.green[i] = uniform(random), dust.blue[i] = uniform(random);
        }
    }
    /// Moves a puff to a depth on the camera's axis.
    void placeAhead(std::size_t i, double metres, float opacity) {
        const glm::vec3 at = this->at(static_cast<float>(metres) * glm::vec3(ahead()));
        dust.x[i] = at.x, dust.y[i] = at.y, dust.z[i] = at.z;
        dust.opacity[i] = opacity;
    }
    pictures::Image drawn(Puff puff, int nodes) {
        AdaptiveTransparency method(puff, wide, nodes);
        method.prepare(scene, {}, device());
        return updateAndDraw(method);
    }
    /// The fragments of a pixel in the order of the puffs, in double precision.
    [[nodiscard]] Fragments fragments(Puff puff, int x, int y) {
        const glm::dvec3 ray = view.rayDirection(x + 0.5, y + 0.5);
        const double perAxisMetre = 1 / glm::dot(ray, ahead());
        const double sceneMetres = sceneAt(x, y) * perAxisMetre;
        Fragments found;
        for (std::size_t i = 0; i < dust.size(); ++i) {
            const glm::dvec3 centre = glm::dvec3(dust.position(i)) - view.camera.eye;
            const double foot = glm::dot(centre, ray), b = glm::length(glm::cross(centre, ray));
            const double opacity = static_cast<double>(dust.opacity[i]), radius = static_cast<double>(dust.radius[i]);
            if (b > 0.5 * wide * radius) continue;
            double depth = foot / perAxisMetre, alpha = 0;
            if (puff == Puff::volume) {
                alpha = -std::expm1(-maths::rayOpticalDepth(opacity, radius, b, foot, 0, sceneMetres));
            } else {
                depth = glm::dot(centre, ahead());
                if (depth < view.camera.nearMetres || depth * perAxisMetre > sceneMetres) continue;
                alpha = maths::billboardOpacity(opacity, radius, b);
            }
            if (alpha < 0.94 * leastAlpha) continue;  // isAmbiguous reports those at the limit
            found.push_back({depth, alpha, glm::dvec3(dust.colour(i)), i});
        }
        return found;
    }

 private:
    [[nodiscard]] glm::dvec3 ahead() const { return glm::normalize(view.camera.target - view.camera.eye); }
    /// Along the camera's axis, metres.
    double sceneAt(int x, int y) {
        if (depths_.empty()) depths_ = layer().sceneDepth().readFloats();
        const float reversed = depths_[static_cast<std::size_t>((view.height - 1 - y) * view.width + x)];
        return reversed > 0 ? view.camera.nearMetres / static_cast<double>(reversed) : 1e9;
    }
    std::vector<float> depths_;
};

glm::dvec4 plainSort(Fragments fragments) {
    std::ranges::stable_sort(fragments, {}, &Fragment::depth);
    glm::dvec3 colour(0);
    double transmittance = 1;
    for (const Fragment& one : fragments) {
        colour += transmittance * one.alpha * one.colour;
        transmittance *= 1 - one.alpha;
    }
    return {colour, 1 - transmittance};
}

PlainVisibility plainVisibility(const Fragments& fragments, int nodes) {
    PlainVisibility visibility(static_cast<std::size_t>(nodes));
    for (const Fragment& one : fragments) visibility.insert(one.depth, 1 - one.alpha);
    return visibility;
}

glm::dvec4 plainPixel(const Fragments& fragments, int nodes) {
    const PlainVisibility visibility = plainVisibility(fragments, nodes);
    glm::dvec3 colour(0);
    for (const Fragment& one : fragments) colour += visibility.at(one.depth) * one.alpha * one.colour;
    return {colour, 1 - visibility.total()};
}

/// Whether rounding to single precision may change which fragments there are, their order, or the nodes that are
/// removed. The last is tried: with fragments that differ by more than the rounding.
bool isAmbiguous(const Fragments& fragments, int nodes) {
    Fragments sorted = fragments;
    std::ranges::sort(sorted, {}, &Fragment::depth);
    for (std::size_t i = 0; i < sorted.size(); ++i) {
        if (sorted[i].alpha < 1.06 * leastAlpha) return true;
        if (i > 0 && sorted[i].depth - sorted[i - 1].depth < 2e-5) return true;
    }
    const glm::dvec4 plain = plainPixel(fragments, nodes);
    std::mt19937 random(1);
    std::uniform_real_distribution<double> uniform(-5e-6, 5e-6);
    for (int trial = 0; trial < 8; ++trial) {
        Fragments moved = fragments;
        for (Fragment& one : moved) {
            one.depth += uniform(random) * std::max(1.0, std::abs(one.depth));
            one.alpha *= 1 + uniform(random);
        }
        if (glm::length(plainPixel(moved, nodes) - plain) > 2e-5) return true;
    }
    return false;
}

TEST(AdaptiveTransparency, SortsExactlyWithAsManyNodesAsFragments) {
    for (const auto& choice : puffKinds.all())
        for (const int nodes : {16, 32}) {
            Cloud cloud(static_cast<std::size_t>(nodes));
            cloud.setGround(1.7);
            const pictures::Image image = cloud.drawn(choice.value, nodes);
            std::size_t most = 0;
            for (int y = 0; y < image.height; y += 2)
                for (int x = 0; x < image.width; x += 2) {
                    const Fragments fragments = cloud.fragments(choice.value, x, y);
                    const glm::dvec4 plain = plainSort(fragments);
                    most = std::max(most, fragments.size());
                    for (int c = 0; c < 4; ++c) ASSERT_NEAR(image.at(x, y)[c], plain[c], 3e-5) << choice.word;
                }
            EXPECT_GT(most, 3u);
        }
}

TEST(AdaptiveTransparency, EqualsThePlainAlgorithm) {
    for (const auto& choice : puffKinds.all())
        for (const int nodes : {2, 3, 8, 13}) {
            Cloud cloud(200, 2);
            cloud.setGround(1.7);
            const pictures::Image image = cloud.drawn(choice.value, nodes);
            double largest = 0;
            int pixels = 0, ambiguous = 0;
            for (int y = 0; y < image.height; y += 3)
                for (int x = 0; x < image.width; x += 3) {
                    const Fragments fragments = cloud.fragments(choice.value, x, y);
                    ++pixels;
                    if (isAmbiguous(fragments, nodes)) {
                        ++ambiguous;
                        continue;
                    }
                    const glm::dvec4 plain = plainPixel(fragments, nodes);
                    for (int c = 0; c < 4; ++c)
                        ASSERT_NEAR(image.at(x, y)[c], plain[c], 5e-5) << choice.word << ' ' << nodes;
                    largest = std::max(largest, glm::length(plain - plainSort(fragments)));
                }
            EXPECT_LT(ambiguous, 0.3 * pixels) << choice.word << ' ' << nodes;
            EXPECT_GT(largest, 0.01) << nodes;  // so that the comparison is not with the exact picture
        }
}

TEST(AdaptiveTransparency, KeepsTotalAlphaAndIsNeverBrighterThanTheExactOrder) {
    for (const auto& choice : puffKinds.all())
        for (const int nodes : {2, 4, 8}) {
            Cloud cloud(200, 3);
            cloud.setGround(1.7);
            const pictures::Image image = cloud.drawn(choice.value, nodes);
            double largestLoss = 0;
            for (int y = 0; y < image.height; y += 2)
                for (int x = 0; x < image.width; x += 2) {
                    const glm::dvec4 exact = plainSort(cloud.fragments(choice.value, x, y));
                    const glm::dvec4 pixel(image.at(x, y));
                    for (int c = 0; c < 3; ++c) ASSERT_LT(pixel[c], exact[c] + 3e-5) << choice.word << ' ' << nodes;
                    ASSERT_NEAR(pixel.a, exact.a, 3e-5) << choice.word << ' ' << nodes;
                    largestLoss = std::max(largestLoss, exact.r - pixel.r);
                }
            EXPECT_GT(largestLoss, 0.01) << nodes;
        }
}

/// Puffs on the camera's axis in a random order. With colours of 1 for one puff per channel and 0 for all others, a
/// channel is that puff's alpha times its visibility.
TEST(AdaptiveTransparency, VisibilityOfAStackFallsFromOneAndEqualsThePlainFunction) {
    constexpr std::size_t count = 12;
    for (const int nodes : {2, 5}) {
        Cloud cloud(count);
        std::mt19937 random(7);
        std::uniform_real_distribution<double> metres(3, 30);
        for (std::size_t i = 0; i < count; ++i)
            cloud.placeAhead(i, metres(random), 0.1f + 0.3f * static_cast<float>(i % 3));
        const int x = cloud.view.width / 2, y = cloud.view.height / 2;
        const Fragments fragments = cloud.fragments(Puff::surface, x, y);
        ASSERT_EQ(fragments.size(), count);
        const PlainVisibility plain = plainVisibility(fragments, nodes);

        std::vector<std::pair<double, double>> seen;  // depth; visibility
        for (std::size_t first = 0; first < count; first += 3) {
            for (std::size_t i = 0; i < count; ++i) {
                cloud.dust.red[i] = i == first ? 1 : 0;
                cloud.dust.green[i] = i == first + 1 ? 1 : 0;
                cloud.dust.blue[i] = i == first + 2 ? 1 : 0;
            }
            const glm::dvec4 pixel(cloud.drawn(Puff::surface, nodes).at(x, y));
            for (int c = 0; c < 3; ++c) {
                const Fragment& one = fragments[first + static_cast<std::size_t>(c)];
                seen.emplace_back(one.depth, pixel[c] / one.alpha);
                EXPECT_NEAR(seen.back().second, plain.at(one.depth), 1e-5) << nodes;
            }
        }
        std::ranges::sort(seen);
        EXPECT_NEAR(seen.front().second, 1, 1e-5) << nodes;
        for (std::size_t i = 1; i < count; ++i) EXPECT_LE(seen[i].second, seen[i - 1].second + 1e-6) << nodes;
    }
}

TEST(AdaptiveTransparency, ErrsLessWithMoreNodes) {
    for (const std::uint32_t seed : {4u, 5u}) {
        Cloud cloud(200, seed);
        double before = 1e9, first = 0;
        for (const int nodes : {2, 4, 8, 16, 32}) {
            const pictures::Image image = cloud.drawn(Puff::surface, nodes);
            double squares = 0;
            for (int y = 0; y < image.height; y += 2)
                for (int x = 0; x < image.width; x += 2) {
                    const glm::dvec4 exact = plainSort(cloud.fragments(Puff::surface, x, y));
                    const glm::dvec4 difference = glm::dvec4(image.at(x, y)) - exact;
                    squares += glm::dot(difference, difference);
                }
            EXPECT_LT(squares, before) << nodes;
            if (nodes == 2) first = squares;
            before = squares;
        }
        EXPECT_LT(before, 0.01 * first);
    }
}

TEST(AdaptiveTransparency, DrawsTheSameAgainAndFollowsACloudThatComesAndGoes) {
    Cloud empty(0), few(20), many(150);
    const MethodInfo info = describe();
    const auto method = info.create(ParameterValues(info.parameters));
    method->prepare(few.scene, {}, Cloud::device());
    const pictures::Image first = few.updateAndDraw(*method);
    EXPECT_EQ(few.draw(*method).pixels, first.pixels);
    (void)many.updateAndDraw(*method);
    for (const glm::vec4& pixel : empty.updateAndDraw(*method).pixels) ASSERT_EQ(pixel, glm::vec4(0));
    EXPECT_EQ(method->primitives(), 0);
    EXPECT_EQ(few.updateAndDraw(*method).pixels, first.pixels);
    Facts facts(info.facts, FactOver::lastFrame);
    method->report(few.frame(), facts);
    EXPECT_EQ(std::get<double>(facts.value("bits_per_pixel").value()), 8 * 64.0);
}

}  // namespace
}  // namespace dustbench::adaptive_transparency
