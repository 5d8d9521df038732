#include "methods/linked_list/linked_list.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>
#include <tuple>

#include "methods/contract/errors.h"
#include "methods/kit/draw/billboards.h"
#include "methods/kit/maths/transmittance.h"
#include "methods/kit/testing/test_moment.h"

namespace dustbench::linked_list {
namespace {

constexpr double wide = 6;  ///< reach of quads that cut nothing off

/// Puffs of several colours that intersect each other, around the eye and in front of it.
class Cloud : public TestMoment {
 public:
    explicit Cloud(std::size_t count, std::uint32_t seed = 1, bool oneColour = false)
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
            dust.opacity[i] = 0.8f * uniform(random);
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
    void copy(std::size_t i, const Cloud& from, std::size_t other) {
        place(i, from.dust.position(other), from.dust.radius[other], from.dust.opacity[other], from.dust.colour(other));
    }
    pictures::Image drawn(Puff puff, double reach = wide, std::int64_t fragmentsPerPixel = 256) {
        LinkedList method(puff, reach, fragmentsPerPixel);
        method.prepare(scene, {}, device());
        return updateAndDraw(method);
    }
    /// A pixel by a sort of its puffs in double precision.
    [[nodiscard]] glm::dvec4 plainPixel(Puff puff, const glm::dvec3& ray, double sceneMetres) const {
        const glm::dvec3 ahead = glm::normalize(view.camera.target - view.camera.eye);
        std::vector<std::tuple<double, std::size_t, double>> fragments;  // depth, number, alpha
        for (std::size_t i = 0; i < dust.size(); ++i) {
            const glm::dvec3 centre = glm::dvec3(dust.position(i)) - view.camera.eye;
            const double foot = glm::dot(centre, ray), b = glm::length(glm::cross(centre, ray));
            const double opacity = static_cast<double>(dust.opacity[i]), radius = static_cast<double>(dust.radius[i]);
            if (puff == Puff::volume) {
                const double depth = maths::rayOpticalDepth(opacity, radius, b, foot, 0, sceneMetres);
                fragments.emplace_back(foot, i, -std::expm1(-depth));
            } else if (const double along = glm::dot(centre, ahead);
                       along >= view.camera.nearMetres && along <= sceneMetres * glm::dot(ray, ahead)) {
                fragments.emplace_back(along, i, maths::billboardOpacity(opacity, radius, b));
            }
        }
        std::ranges::sort(fragments);
        glm::dvec4 blended(0);
        for (const auto& [depth, i, alpha] : fragments)
            blended += (1 - blended.a) * alpha * glm::dvec4(dust.colour(i), 1);
        return blended;
    }
    [[nodiscard]] double sceneAt(int x, int y, const glm::dvec3& ray) {
        const std::vector<float> depth = layer().sceneDepth().readFloats();
        const float reversed = depth[static_cast<std::size_t>((view.height - 1 - y) * view.width + x)];
        const glm::dvec3 ahead = glm::normalize(view.camera.target - view.camera.eye);
        return reversed > 0 ? view.camera.nearMetres / static_cast<double>(reversed) / glm::dot(ray, ahead) : 1e9;
    }
};

double largestDifference(const pictures::Image& a, const pictures::Image& b) {
    double largest = 0;
    for (std::size_t i = 0; i < a.pixels.size(); ++i)
        for (int c = 0; c < 4; ++c)
            largest = std::max(largest, std::abs(static_cast<double>(a.pixels[i][c] - b.pixels[i][c])));
    return largest;
}

TEST(LinkedList, EqualsAPlainSortOfEachPixel) {
    for (const auto& choice : puffKinds.all())
        for (const std::uint32_t seed : {1u, 2u, 3u}) {
            Cloud cloud(200, seed, seed == 3);
            cloud.setGround(1.7);
            const pictures::Image image = cloud.drawn(choice.value);
            double most = 0;
            for (int y = 0; y < image.height; y += 3)
                for (int x = 0; x < image.width; x += 3) {
                    const glm::dvec3 ray = cloud.view.rayDirection(x + 0.5, y + 0.5);
                    const glm::dvec4 plain = cloud.plainPixel(choice.value, ray, cloud.sceneAt(x, y, ray));
                    most = std::max(most, plain.a);
                    for (int c = 0; c < 4; ++c)
                        ASSERT_NEAR(image.at(x, y)[c], plain[c], 3e-5) << choice.word << ' ' << x << ' ' << y;
                }
            EXPECT_GT(most, 0.9);
        }
}

/// Layers of puffs that touch none of the next layer: billboards in the order from far to near have the same picture.
TEST(LinkedList, EqualsSortedBillboardsWhereNoPuffsIntersect) {
    constexpr std::size_t layers = 12;
    Cloud cloud(layers, 7);
    cloud.lookFrom({0, 2, 0}, {0, 0, -1});
    std::vector<std::size_t> shuffled(layers);
    std::iota(shuffled.begin(), shuffled.end(), 0u);
    std::ranges::shuffle(shuffled, std::mt19937(5));
    for (std::size_t k = 0; k < layers; ++k) {
        const auto distance = 8 + 3 * static_cast<float>(k);
        cloud.place(shuffled[k], {0.05f * distance * std::sin(static_cast<float>(k)), 2, -distance}, 1.4f, 0.6f,
                    cloud.dust.colour(shuffled[k]));
    }
    const pictures::Image image = cloud.drawn(Puff::surface, 4);
    const auto billboards = [&cloud](auto numberOf) {
        draw::Billboards quads(Cloud::device(), {}, nullptr);
        const draw::InstanceLayout layout = quads.layout(true);
        float* value = quads.map(layers, layout).data();
        for (std::size_t place = 0; place < layers; ++place) {
            const std::size_t i = numberOf(place);
            const glm::vec3 at = cloud.dust.position(i), colour = cloud.dust.colour(i);
            for (const float each :
                 {at.x, at.y, at.z, cloud.dust.radius[i], cloud.dust.opacity[i], colour.r, colour.g, colour.b})
                *value++ = each;
        }
        quads.unmap();
        return cloud.picture([&](gpu::Layer& layer) { quads.draw(cloud.view, cloud.dust.colourOfAll, layer); });
    };
    const pictures::Image sorted = billboards([&](std::size_t place) { return shuffled[layers - 1 - place]; });
    const pictures::Image unsorted = billboards([](std::size_t place) { return place; });
    EXPECT_LT(largestDifference(image, sorted), 0.02);  // billboards cut off up to τ·exp(−9/2)
    EXPECT_GT(largestDifference(image, unsorted), 0.1);
}

TEST(LinkedList, DoesNotDependOnTheOrderToTheBit) {
    for (const auto& choice : puffKinds.all()) {
        Cloud cloud(200, 3), reversed(200, 3);
        for (std::size_t i = 0; i < 200; ++i) reversed.copy(i, cloud, 199 - i);
        EXPECT_EQ(cloud.drawn(choice.value).pixels, reversed.drawn(choice.value).pixels) << choice.word;
    }
}

TEST(LinkedList, BlendsPuffsAtOneDepthInTheOrderOfTheirNumbers) {
    Cloud cloud(2);
    const glm::vec3 ahead =
        cloud.at(8.0f * glm::normalize(glm::vec3(cloud.view.camera.target) - glm::vec3(cloud.view.camera.eye)));
    for (const std::size_t first : {0u, 1u}) {
        cloud.place(first, ahead, 1, 0.5f, {1, 0, 0});
        cloud.place(1 - first, ahead, 1, 0.5f, {0, 0, 1});
        const pictures::Image image = cloud.drawn(Puff::surface);
        const glm::vec4 middle = image.at(image.width / 2, image.height / 2);
        EXPECT_EQ(middle.r > middle.b, first == 0);
    }
}

std::string messageOf(Cloud& cloud, std::int64_t fragmentsPerPixel) {
    try {
        LinkedList method(Puff::surface, 3.5, fragmentsPerPixel);
        method.prepare(cloud.scene, {}, Cloud::device());
        (void)cloud.updateAndDraw(method);
        const MethodInfo info = describe();
        Facts facts(info.facts, FactOver::lastFrame);
        method.report(cloud.frame(), facts);
    } catch (const InputError& error) {
        return error.what();
    }
    return "";
}

/// Three puffs around the view's axis whose quads cover the picture: 3 · 96 · 72 fragments.
TEST(LinkedList, NamesBothNumbersIfThePoolIsTooSmall) {
    Cloud cloud(3);
    const glm::vec3 ahead = glm::normalize(glm::vec3(cloud.view.camera.target) - glm::vec3(cloud.view.camera.eye));
    for (std::size_t i = 0; i < 3; ++i)
        cloud.place(i, cloud.at((5 + static_cast<float>(i)) * ahead), 20, 0.5f, {1, 0, 0});
    EXPECT_EQ(messageOf(cloud, 2),
              "linked_list: got 20736 fragments at 96x72 pixels, expected at most 13824 (fragments_per_pixel=2; 3 is "
              "sufficient)");
    EXPECT_EQ(messageOf(cloud, 3), "");
}

/// Puffs on the view's axis, in random order of depth.
void pile(Cloud& cloud) {
    const std::size_t count = cloud.dust.size();
    const glm::vec3 ahead = glm::normalize(glm::vec3(cloud.view.camera.target) - glm::vec3(cloud.view.camera.eye));
    std::vector<std::size_t> order(count);
    std::iota(order.begin(), order.end(), 0);
    std::ranges::shuffle(order, std::mt19937(4));
    for (std::size_t i = 0; i < count; ++i) {
        const float depth = static_cast<float>(i) / static_cast<float>(count);
        cloud.place(order[i], cloud.at((5 + 5 * depth) * ahead), 0.1f, 0.004f, {depth, 1 - depth, 0});
    }
}

/// A shader of Mesa 22's llvmpipe ends its loops after 65,535 iterations: without a check, long lists would be sorted
/// in part. Mesa 25 has no such limit.
TEST(LinkedList, SortsLongListsOrSaysThatItCannot) {
    const auto expectSorted = [](Cloud& cloud, const pictures::Image& image) {
        const int x = image.width / 2, y = image.height / 2;
        const glm::dvec3 ray = cloud.view.rayDirection(x + 0.5, y + 0.5);
        const glm::dvec4 expected = cloud.plainPixel(Puff::surface, ray, cloud.sceneAt(x, y, ray));
        for (int c = 0; c < 4; ++c) EXPECT_NEAR(image.at(x, y)[c], expected[c], 1e-4);
        EXPECT_GT(expected.g, 2 * expected.r) << "the order must matter";
    };
    Cloud shorter(2'000), longer(12'000);
    pile(shorter);
    pile(longer);
    expectSorted(shorter, shorter.drawn(Puff::surface));

    const std::string message = messageOf(longer, 256);
    if (message.empty()) return expectSorted(longer, longer.drawn(Puff::surface, 3.5, 256));
    EXPECT_TRUE(Cloud::device().isSoftware());
    EXPECT_THAT(message, testing::HasSubstr("too many puffs in a pixel"));
}

TEST(LinkedList, DrawsTheSameAgainAndFollowsACloudThatComesAndGoes) {
    Cloud empty(0), few(40), one(50, 2, true);
    const MethodInfo info = describe();
    const auto method = info.create(ParameterValues(info.parameters));
    method->prepare(few.scene, {}, Cloud::device());
    const pictures::Image first = few.updateAndDraw(*method);
    EXPECT_EQ(few.draw(*method).pixels, first.pixels);
    (void)one.updateAndDraw(*method);
    for (const glm::vec4& pixel : empty.updateAndDraw(*method).pixels) ASSERT_EQ(pixel, glm::vec4(0));
    EXPECT_EQ(method->primitives(), 0);
    EXPECT_EQ(few.updateAndDraw(*method).pixels, first.pixels);
}

/// A puff around the view covers each pixel once: a head of 32 bits and a fragment of 128.
TEST(LinkedList, ReportsTheBitsInUse) {
    const MethodInfo info = describe();
    Cloud cloud(1);
    const glm::vec3 ahead = glm::normalize(glm::vec3(cloud.view.camera.target) - glm::vec3(cloud.view.camera.eye));
    cloud.place(0, cloud.at(5.0f * ahead), 20, 0.5f, {1, 0, 0});
    const auto method = info.create(ParameterValues(info.parameters));
    method->prepare(cloud.scene, {}, Cloud::device());
    (void)cloud.updateAndDraw(*method);
    Facts facts(info.facts, FactOver::lastFrame);
    method->report(cloud.frame(), facts);
    EXPECT_EQ(std::get<double>(facts.value("bits_per_pixel").value()), 32 + 128);
    std::size_t pool = 0;
    for (const MemoryUse& use : method->memory())
        if (use.structure == "fragments") pool = use.gpuBytes;
    EXPECT_EQ(pool, (96u * 72u * 32u + 1u) * 16u);
}

}  // namespace
}  // namespace dustbench::linked_list
