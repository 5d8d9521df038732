#include "methods/multi_layer/multi_layer.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "methods/contract/errors.h"
#include "methods/kit/maths/transmittance.h"
#include "methods/kit/testing/test_moment.h"

namespace dustbench::multi_layer {
namespace {

constexpr double wide = 6;           ///< reach that cuts nothing off
constexpr double leastAlpha = 1e-5;  ///< of a fragment, as in the shader

/// A fragment, or layers merged into one.
struct Fragment {
    double depth;
    glm::dvec3 colour;  ///< premultiplied
    double transmittance;
};

/// Puffs of several colours that intersect each other, around the eye and in front of it.
class Cloud : public TestMoment {
 public:
    explicit Cloud(std::size_t count, std::uint32_t seed = 1, bool oneColour = false)
        : TestMoment(count, 93, 70, {0, 2, 0}, {0.1, -0.15, -1}) {
        std::mt19937 random(seed);
        std::uniform_real_distribution<float> uniform(0, 1);
        dust.keepOneColour(oneColour);
        for (std::size_t i = 0; i < count; ++i) {
            dust.serial[i] = i;
            dust.x[i] = 12 * uniform(random) - 6;
            dust.y[i] = 4 * uniform(random);
            dust.z[i] = 3 - 30 * uniform(random);
            dust.radius[i] = 0.3f + uniform(random);
            dust.opacity[i] = 0.8f * uniform(random);
            dust.lifetime[i] = 5;
            if (oneColour) continue;
            dust.red[i] = uniform(random), dust.green[i] = uniform(random), dust.blue[i] = uniform(random);
        }
        dust.colourOfAll = {0.6f, 0.4f, 0.2f};
    }
    pictures::Image drawn(Puff puff, int layers) {
        MultiLayer method(puff, wide, layers);
        method.prepare(scene, {}, device());
        return updateAndDraw(method);
    }
    /// The fragments of a pixel in the order of the puffs, in double precision.
    [[nodiscard]] std::vector<Fragment> fragments(Puff puff, int x, int y) {
        const glm::dvec3 ray = view.rayDirection(x + 0.5, y + 0.5);
        const glm::dvec3 ahead = glm::normalize(view.camera.target - view.camera.eye);
        const double sceneMetres = sceneAt(x, y) / glm::dot(ray, ahead);
        std::vector<Fragment> found;
        for (std::size_t i = 0; i < dust.size(); ++i) {
            const glm::dvec3 centre = glm::dvec3(dust.position(i)) - view.camera.eye;
            const double foot = glm::dot(centre, ray), b = glm::length(glm::cross(centre, ray));
            const double opacity = static_cast<double>(dust.opacity[i]), radius = static_cast<double>(dust.radius[i]);
            if (b > 0.5 * wide * radius) continue;
            double depth = foot, alpha = 0;
            if (puff == Puff::volume) {
                alpha = -std::expm1(-maths::rayOpticalDepth(opacity, radius, b, foot, 0, sceneMetres));
            } else {
                depth = glm::dot(centre, ahead);
                if (depth < view.camera.nearMetres || depth > sceneMetres * glm::dot(ray, ahead)) continue;
                alpha = maths::billboardOpacity(opacity, radius, b);
            }
            if (alpha < 0.94 * leastAlpha) continue;  // isAmbiguous reports those at the limit
            found.push_back({depth, alpha * glm::dvec3(dust.colour(i)), 1 - alpha});
        }
        return found;
    }

 private:
    /// Along the camera's axis, metres.
    double sceneAt(int x, int y) {
        if (depths_.empty()) depths_ = layer().sceneDepth().readFloats();
        const float reversed = depths_[static_cast<std::size_t>((view.height - 1 - y) * view.width + x)];
        return reversed > 0 ? view.camera.nearMetres / static_cast<double>(reversed) : 1e9;
    }
    std::vector<float> depths_;
};

glm::dvec4 composed(const std::vector<Fragment>& sorted) {
    glm::dvec3 colour(0);
    double transmittance = 1;
    for (const Fragment& one : sorted) {
        colour += transmittance * one.colour;
        transmittance *= one.transmittance;
    }
    return {colour, 1 - transmittance};
}

glm::dvec4 plainSort(std::vector<Fragment> fragments) {
    std::ranges::stable_sort(fragments, {}, &Fragment::depth);
    return composed(fragments);
}

/// The paper's algorithm with a sort per fragment.
glm::dvec4 plainLayers(const std::vector<Fragment>& fragments, std::size_t layers) {
    std::vector<Fragment> kept;
    for (const Fragment& one : fragments) {
        kept.push_back(one);
        std::ranges::stable_sort(kept, {}, &Fragment::depth);
        if (kept.size() <= layers) continue;
        Fragment& last = kept[layers - 1];
        last.colour += last.transmittance * kept[layers].colour;
        last.transmittance *= kept[layers].transmittance;
        kept.pop_back();
    }
    return composed(kept);
}

/// Whether rounding to single precision may change which fragments there are, or their order.
bool isAmbiguous(std::vector<Fragment> fragments) {
    std::ranges::sort(fragments, {}, &Fragment::depth);
    for (std::size_t i = 0; i < fragments.size(); ++i) {
        if (1 - fragments[i].transmittance < 1.06 * leastAlpha) return true;
        if (i > 0 && fragments[i].depth - fragments[i - 1].depth < 2e-5) return true;
    }
    return false;
}

TEST(MultiLayer, SortsExactlyWithAsManyLayersAsFragments) {
    for (const auto& choice : puffKinds.all()) {
        Cloud cloud(16);
        cloud.setGround(1.7);
        const pictures::Image image = cloud.drawn(choice.value, 16);
        std::size_t most = 0;
        for (int y = 0; y < image.height; y += 2)
            for (int x = 0; x < image.width; x += 2) {
                const std::vector<Fragment> fragments = cloud.fragments(choice.value, x, y);
                const glm::dvec4 plain = plainSort(fragments);
                most = std::max(most, fragments.size());
                for (int c = 0; c < 4; ++c) ASSERT_NEAR(image.at(x, y)[c], plain[c], 3e-5) << choice.word;
            }
        EXPECT_GT(most, 3u);
    }
}

/// Puffs along one ray, one more than layers; the last lies between the two farthest. Merging after it is exact. With
/// one layer less, the two farthest are merged before it.
TEST(MultiLayer, IsExactUntilAFragmentFallsBetweenMergedLayers) {
    for (const int layers : {2, 3, 5}) {
        Cloud cloud(static_cast<std::size_t>(layers + 1));
        const glm::vec3 ahead = glm::vec3(glm::normalize(cloud.view.camera.target - cloud.view.camera.eye));
        for (int i = 0; i <= layers; ++i) {
            const double place = i < layers ? i : layers - 1.5;
            const auto puff = static_cast<std::size_t>(i);
            const glm::vec3 at = cloud.at(static_cast<float>(4 + 3 * place) * ahead);
            cloud.dust.x[puff] = at.x, cloud.dust.y[puff] = at.y, cloud.dust.z[puff] = at.z;
            cloud.dust.opacity[puff] = 0.6f;
        }
        const int x = cloud.view.width / 2, y = cloud.view.height / 2;
        const glm::dvec4 plain = plainSort(cloud.fragments(Puff::surface, x, y));
        const auto errorWith = [&](int count) {
            return glm::length(glm::dvec4(cloud.drawn(Puff::surface, count).at(x, y)) - plain);
        };
        EXPECT_LT(errorWith(layers), 3e-5) << layers;
        EXPECT_GT(errorWith(layers - 1), 1e-3) << layers;
    }
}

TEST(MultiLayer, EqualsThePlainAlgorithmAndKeepsTotalAlpha) {
    for (const auto& choice : puffKinds.all())
        for (const int layers : {1, 2, 4, 7}) {
            Cloud cloud(200, 2);
            cloud.setGround(1.7);
            const pictures::Image image = cloud.drawn(choice.value, layers);
            double largest = 0;
            int pixels = 0, ambiguous = 0;
            for (int y = 0; y < image.height; y += 3)
                for (int x = 0; x < image.width; x += 3) {
                    const std::vector<Fragment> fragments = cloud.fragments(choice.value, x, y);
                    ++pixels;
                    if (isAmbiguous(fragments)) {
                        ++ambiguous;
                        continue;
                    }
                    const glm::dvec4 plain = plainLayers(fragments, static_cast<std::size_t>(layers));
                    const glm::dvec4 exact = plainSort(fragments);
                    for (int c = 0; c < 4; ++c)
                        ASSERT_NEAR(image.at(x, y)[c], plain[c], 5e-5) << choice.word << ' ' << layers;
                    ASSERT_NEAR(image.at(x, y).a, exact.a, 2e-5) << choice.word << ' ' << layers;
                    largest = std::max(largest, glm::length(plain - exact));
                }
            EXPECT_LT(ambiguous, 0.3 * pixels);
            EXPECT_GT(largest, 0.01) << layers;  // so that the comparison is not with the exact picture
        }
}

TEST(MultiLayer, IsExactForOneColourWithAnyNumberOfLayers) {
    for (const int layers : {1, 3, 16}) {
        Cloud cloud(200, 3, true);
        cloud.setGround(1.7);
        const pictures::Image image = cloud.drawn(Puff::volume, layers);
        for (int y = 0; y < image.height; y += 3)
            for (int x = 0; x < image.width; x += 3) {
                const glm::dvec4 exact = plainSort(cloud.fragments(Puff::volume, x, y));
                for (int c = 0; c < 4; ++c) ASSERT_NEAR(image.at(x, y)[c], exact[c], 3e-5) << layers;
            }
    }
}

TEST(MultiLayer, ErrsLessWithMoreLayers) {
    Cloud cloud(60, 4);
    double before = 1e9, first = 0;
    for (const int layers : {1, 2, 4, 8, 16}) {
        const pictures::Image image = cloud.drawn(Puff::surface, layers);
        double squares = 0;
        for (int y = 0; y < image.height; y += 2)
            for (int x = 0; x < image.width; x += 2) {
                const glm::dvec4 difference =
                    glm::dvec4(image.at(x, y)) - plainSort(cloud.fragments(Puff::surface, x, y));
                squares += glm::dot(difference, difference);
            }
        EXPECT_LT(squares, before) << layers;
        if (layers == 1) first = squares;
        before = squares;
    }
    EXPECT_LT(before, 0.1 * first);
}

TEST(MultiLayer, DrawsTheSameAgainAndFollowsACloudThatComesAndGoes) {
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
    EXPECT_EQ(std::get<double>(facts.value("bits_per_pixel").value()), 4 * 160.0);
    EXPECT_EQ(std::get<std::int64_t>(facts.value("bytes_per_fragment").value()), 0);
}

/// llvmpipe of Mesa 22 ends the loops of an invocation after 65,535 iterations: unnoticed, pixels would show a part of
/// the puffs. Mesa 25 does not.
TEST(MultiLayer, ShowsAllPuffsOfAPixelOrSaysThatItCannot) {
    const auto middleOf = [](std::size_t puffs, double depth) {
        Cloud pile(puffs, 1, true);
        for (std::size_t i = 0; i < puffs; ++i) {
            pile.dust.x[i] = 0.8f, pile.dust.y[i] = 0.8f, pile.dust.z[i] = -8;
            pile.dust.radius[i] = 2, pile.dust.opacity[i] = static_cast<float>(-std::expm1(-depth));
        }
        MultiLayer method(Puff::surface, wide, 4);
        method.prepare(pile.scene, {}, Cloud::device());
        const pictures::Image image = pile.updateAndDraw(method);
        const MethodInfo info = describe();
        Facts facts(info.facts, FactOver::lastFrame);
        method.report(pile.frame(), facts);
        return image.at(image.width / 2, image.height / 2).a;
    };
    // The same depth in 70 puffs and in 70,000.
    const float expected = middleOf(70, 0.05);
    EXPECT_GT(expected, 0.5f);
    try {
        EXPECT_NEAR(middleOf(70'000, 5e-5), expected, 0.002f) << "65,535 puffs would lack 6 % of the depth";
    } catch (const InputError& error) {
        EXPECT_THAT(error.what(), testing::HasSubstr("multi_layer: got too many puffs"));
        EXPECT_TRUE(Cloud::device().isSoftware());
    }
}

}  // namespace
}  // namespace dustbench::multi_layer
