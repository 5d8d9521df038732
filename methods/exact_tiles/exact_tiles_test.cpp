#include "methods/exact_tiles/exact_tiles.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "methods/contract/errors.h"
#include "methods/kit/maths/transmittance.h"
#include "methods/kit/testing/test_moment.h"

namespace dustbench::exact_tiles {
namespace {

constexpr double tolerance = 1e-5;

/// Random puffs in front of and around an eye.
class Cloud : public TestMoment {
 public:
    Cloud(std::size_t count, int width, int height, std::uint32_t seed = 1)
        : TestMoment(count, width, height, {0, 2, 0}, {0.1, -0.15, -1}) {
        std::mt19937 random(seed);
        std::uniform_real_distribution<float> uniform(0, 1);
        for (std::size_t i = 0; i < count; ++i) {
            dust.serial[i] = 1000 + i;
            dust.x[i] = 16 * uniform(random) - 8;
            dust.y[i] = 4 * uniform(random);
            dust.z[i] = 4 - 40 * uniform(random) * uniform(random);
            dust.radius[i] = 0.25f + 1.35f * uniform(random);
            dust.opacity[i] = 0.4f * uniform(random) * uniform(random);
            dust.lifetime[i] = 5;
            dust.age[i] = 1;
        }
        dust.colourOfAll = {0.6f, 0.4f, 0.2f};
    }

    /// Dense puffs of two colours.
    void colourByTurns() {
        dust.keepOneColour(false);
        for (std::size_t i = 0; i < dust.size(); ++i) {
            dust.opacity[i] = 0.5f + dust.opacity[i];
            dust.red[i] = i % 2 ? 0.8f : 0.1f;
            dust.green[i] = 0.3f;
            dust.blue[i] = 0.9f - dust.red[i];
        }
    }
};

double sceneMetres(const std::vector<float>& depth, const Cloud& cloud, int x, int y, const glm::dvec3& ray) {
    const float reversed = depth[static_cast<std::size_t>((cloud.view.height - 1 - y) * cloud.view.width + x)];
    if (reversed <= 0) return std::numeric_limits<double>::infinity();
    const glm::dvec3 ahead = glm::normalize(cloud.view.camera.target - cloud.view.camera.eye);
    return cloud.view.camera.nearMetres / static_cast<double>(reversed) / glm::dot(ray, ahead);
}

/// The pixel's ray in double precision (View::rayDirection is single precision).
glm::dvec3 rayOf(const scene::View& view, int x, int y) {
    const glm::dvec3 ahead = glm::normalize(view.camera.target - view.camera.eye);
    const glm::dvec3 right = glm::normalize(glm::cross(ahead, view.camera.up)), up = glm::cross(right, ahead);
    const double slope = 2 * std::tan(view.camera.verticalFieldOfView / 2) / view.height;
    return glm::normalize(ahead + (x + 0.5 - 0.5 * view.width) * slope * right +
                          (0.5 * view.height - y - 0.5) * slope * up);
}

/// Every pixel's depth by definition: the sum over all puffs, nothing neglected.
double plainDepth(const Cloud& cloud, const glm::dvec3& ray, double from, double to) {
    double depth = 0;
    for (std::size_t i = 0; i < cloud.dust.size(); ++i) {
        const glm::dvec3 centre = glm::dvec3(cloud.dust.position(i)) - cloud.view.camera.eye;
        depth += maths::rayOpticalDepth(static_cast<double>(cloud.dust.opacity[i]),
                                        static_cast<double>(cloud.dust.radius[i]), glm::length(glm::cross(centre, ray)),
                                        glm::dot(centre, ray), from, to);
    }
    return depth;
}

void expectExact(Cloud& cloud, const Settings& settings = {}) {
    ExactTiles method(settings);
    method.prepare(cloud.scene, {}, Cloud::device());
    const pictures::Image image = cloud.updateAndDraw(method);
    const std::vector<float> depth = cloud.layer().sceneDepth().readFloats();
    double largest = 0, most = 0;
    for (int y = 0; y < image.height; ++y)
        for (int x = 0; x < image.width; ++x) {
            const glm::dvec3 ray = rayOf(cloud.view, x, y);
            const double alpha = -std::expm1(-plainDepth(cloud, ray, 0, sceneMetres(depth, cloud, x, y, ray)));
            for (int c = 0; c < 4; ++c) {
                const double exact = c < 3 ? alpha * static_cast<double>(cloud.dust.colourOfAll[c]) : alpha;
                largest = std::max(largest, std::abs(static_cast<double>(image.at(x, y)[c]) - exact));
            }
            most = std::max(most, alpha);
        }
    EXPECT_LT(largest, tolerance);
    EXPECT_GT(most, 0.3);
    testing::Test::RecordProperty("largest_difference", std::to_string(largest));
}

TEST(ExactTiles, EqualsTheClosedFormInSeveralSizes) {
    for (const auto& [width, height] : {std::pair{160, 120}, {97, 61}, {8, 8}, {33, 200}}) {
        SCOPED_TRACE(width);
        Cloud cloud(300, width, height, static_cast<std::uint32_t>(width));
        expectExact(cloud);
    }
}

TEST(ExactTiles, EqualsTheClosedFormOverGroundAndWall) {
    Cloud cloud(300, 120, 90, 5);
    cloud.setGround(1.6);
    expectExact(cloud);
    cloud.setWall(9.0, 50);
    expectExact(cloud);
    cloud.setWall(0.3);
    Cloud near(0, 64, 48);
    near.dust.resize(1);
    near.setWall(0.5);
    near.dust.z[0] = 0, near.dust.y[0] = 2, near.dust.radius[0] = 2, near.dust.opacity[0] = 0.98f;
    near.dust.lifetime[0] = 5;
    near.dust.colourOfAll = {0.6f, 0.4f, 0.2f};
    expectExact(near);
}

TEST(ExactTiles, EqualsTheClosedFormFromWithinAPuff) {
    Cloud cloud(200, 120, 90, 7);
    for (std::size_t i = 0; i < 40; ++i) {  // around the eye, some wholly behind it
        cloud.dust.x[i] *= 0.1f;
        cloud.dust.y[i] = 2 + 0.1f * cloud.dust.y[i];
        cloud.dust.z[i] = 0.02f * cloud.dust.z[i];
    }
    expectExact(cloud);
}

TEST(ExactTiles, EqualsTheClosedFormOfSmallPuffsFarAway) {
    Cloud cloud(400, 160, 120, 11);
    for (std::size_t i = 0; i < cloud.dust.size(); ++i) {
        cloud.dust.x[i] *= 2;
        cloud.dust.z[i] = 3 * cloud.dust.z[i] - 90;
        cloud.dust.radius[i] = 0.25f;
        cloud.dust.opacity[i] = 0.9f;
    }
    for (std::size_t i = 0; i < 300; ++i) {  // one ahead of the eye, so that something is dense
        cloud.dust.x[i] = 0.05f * cloud.dust.x[i] + 10;
        cloud.dust.y[i] = -13 + 0.2f * cloud.dust.y[i];
        cloud.dust.z[i] = 0.02f * cloud.dust.z[i] - 97;
    }
    expectExact(cloud);
}

TEST(ExactTiles, MarchesSeveralColoursToTheIntegral) {
    Cloud cloud(120, 40, 30, 3);
    cloud.colourByTurns();
    cloud.setGround(1.6);
    const auto marched = [&](double slabDeviations) {
        ExactTiles method({.slabDeviations = slabDeviations});
        method.prepare(cloud.scene, {}, Cloud::device());
        return cloud.updateAndDraw(method);
    };
    const pictures::Image image = marched(0.1), half = marched(0.5), less = marched(1);
    double largestHalf = 0;
    const std::vector<float> depth = cloud.layer().sceneDepth().readFloats();
    double largest = 0, largestAlpha = 0, fineSum = 0, coarseSum = 0, spread = 0;
    for (int y = 0; y < image.height; y += 3)
        for (int x = 0; x < image.width; x += 3) {
            const glm::dvec3 ray = rayOf(cloud.view, x, y);
            const double scene = std::min(sceneMetres(depth, cloud, x, y, ray), 60.0);
            // ∫ T·Σσc dt by the midpoint rule in small steps.
            glm::dvec3 colour(0);
            double sum = 0;
            const int steps = static_cast<int>(scene / 0.01);
            for (int k = 0; k < steps; ++k) {
                const double t = (k + 0.5) * scene / steps;
                double extinction = 0;
                glm::dvec3 emission(0);
                for (std::size_t i = 0; i < cloud.dust.size(); ++i) {
                    const glm::dvec3 at = cloud.view.camera.eye + t * ray;
                    const double one = maths::puffExtinctionPerMetre(
                        static_cast<double>(cloud.dust.opacity[i]), static_cast<double>(cloud.dust.radius[i]),
                        glm::length(glm::dvec3(cloud.dust.position(i)) - at));
                    extinction += one;
                    emission += one * glm::dvec3(cloud.dust.colour(i));
                }
                const double step = scene / steps;
                colour += emission * step * std::exp(-sum - 0.5 * extinction * step);
                sum += extinction * step;
            }
            for (int c = 0; c < 3; ++c) {
                largest = std::max(largest, std::abs(static_cast<double>(image.at(x, y)[c]) - colour[c]));
                largestHalf = std::max(largestHalf, std::abs(static_cast<double>(half.at(x, y)[c]) - colour[c]));
                fineSum += std::abs(static_cast<double>(half.at(x, y)[c]) - colour[c]);
                coarseSum += std::abs(static_cast<double>(less.at(x, y)[c]) - colour[c]);
            }
            largestAlpha = std::max(largestAlpha, std::abs(static_cast<double>(image.at(x, y).a) + std::expm1(-sum)));
            spread = std::max(spread, std::abs(colour.r - colour.b));
        }
    EXPECT_LT(largest, tolerance);
    EXPECT_LT(largestHalf, 1e-4);
    EXPECT_LT(largestAlpha, tolerance);
    EXPECT_GT(coarseSum, 3 * fineSum);  // second order
    EXPECT_LT(coarseSum, 6 * fineSum);
    EXPECT_GT(spread, 0.1);
}

TEST(ExactTiles, SumsAPixelAtATimeAsItSumsSeveral) {
    Cloud cloud(200, 90, 70, 13);
    cloud.setGround(1.6);
    ExactTiles several({.rowsAtOnce = 8}), one({.rowsAtOnce = 1});
    several.prepare(cloud.scene, {}, Cloud::device());
    one.prepare(cloud.scene, {}, Cloud::device());
    const pictures::Image a = cloud.updateAndDraw(several), b = cloud.updateAndDraw(one);
    for (std::size_t i = 0; i < a.pixels.size(); ++i)
        for (int c = 0; c < 4; ++c) ASSERT_NEAR(a.pixels[i][c], b.pixels[i][c], 1e-6f);
}

TEST(ExactTiles, GivesOneColourTheSamePictureEitherWay) {
    Cloud cloud(200, 80, 60, 9);
    cloud.setGround(1.6);
    ExactTiles method({});
    method.prepare(cloud.scene, {}, Cloud::device());
    const pictures::Image one = cloud.updateAndDraw(method);
    cloud.dust.keepOneColour(false);
    for (std::size_t i = 0; i < cloud.dust.size(); ++i) {
        cloud.dust.red[i] = cloud.dust.colourOfAll.r;
        cloud.dust.green[i] = cloud.dust.colourOfAll.g;
        cloud.dust.blue[i] = cloud.dust.colourOfAll.b;
    }
    const pictures::Image marched = cloud.updateAndDraw(method);
    for (std::size_t i = 0; i < one.pixels.size(); ++i)
        for (int c = 0; c < 4; ++c) ASSERT_NEAR(marched.pixels[i][c], one.pixels[i][c], 1e-5f);
}

TEST(ExactTiles, DrawsTheSameAgainAndFollowsACameraThatTurnsWithoutAnUpdate) {
    Cloud cloud(150, 64, 48);
    ExactTiles method({});
    method.prepare(cloud.scene, {}, Cloud::device());
    const pictures::Image first = cloud.updateAndDraw(method);
    EXPECT_EQ(cloud.draw(method).pixels, first.pixels);
    EXPECT_EQ(cloud.updateAndDraw(method).pixels, first.pixels);
    cloud.lookFrom({1, 2, 3}, {-0.3, -0.1, -1});
    const pictures::Image turned = cloud.draw(method);
    EXPECT_NE(turned.pixels, first.pixels);
    EXPECT_EQ(cloud.updateAndDraw(method).pixels, turned.pixels);
}

std::size_t tileBytes(const ExactTiles& method) {
    for (const MemoryUse& use : method.memory())
        if (use.structure == "tiles") return use.gpuBytes;
    return 0;
}

TEST(ExactTiles, NeglectsNoMoreThanItIsAllowedTo) {
    Cloud cloud(300, 96, 72);
    ExactTiles exact({.toleratedDepth = 1e-9}), fast({.toleratedDepth = 0.01});
    exact.prepare(cloud.scene, {}, Cloud::device());
    fast.prepare(cloud.scene, {}, Cloud::device());
    const pictures::Image full = cloud.updateAndDraw(exact), less = cloud.updateAndDraw(fast);
    double largest = 0;
    for (std::size_t i = 0; i < full.pixels.size(); ++i)
        largest = std::max(largest, static_cast<double>(full.pixels[i].a - less.pixels[i].a));
    EXPECT_LT(largest, 0.01);
    EXPECT_GT(largest, 1e-5);
    EXPECT_GT(tileBytes(exact), tileBytes(fast));
}

TEST(ExactTiles, FollowsACloudThatComesAndGoes) {
    Cloud empty(0, 64, 48), few(10, 64, 48), many(3'000, 64, 48);
    ExactTiles method({});
    method.prepare(empty.scene, {}, Cloud::device());
    for (const glm::vec4& pixel : empty.updateAndDraw(method).pixels) ASSERT_EQ(pixel, glm::vec4(0));
    const pictures::Image first = few.updateAndDraw(method);
    (void)many.updateAndDraw(method);
    EXPECT_GT(method.primitives(), 1'000);
    for (const glm::vec4& pixel : empty.updateAndDraw(method).pixels) ASSERT_EQ(pixel, glm::vec4(0));
    EXPECT_EQ(few.updateAndDraw(method).pixels, first.pixels);
}

/// llvmpipe of Mesa 22 ends the loops of an invocation after 65,535 iterations: unnoticed, pixels would show a part of
/// the puffs. Mesa 25 does not.
TEST(ExactTiles, ShowsAllPuffsOfAPixelOrSaysThatItCannot) {
    const auto middleOf = [](std::size_t puffs, double depth) {
        Cloud pile(puffs, 64, 48);
        for (std::size_t i = 0; i < puffs; ++i) {
            pile.dust.x[i] = 0.8f, pile.dust.y[i] = 0.8f, pile.dust.z[i] = -8;
            pile.dust.radius[i] = 2, pile.dust.opacity[i] = static_cast<float>(-std::expm1(-depth));
        }
        ExactTiles method({});
        method.prepare(pile.scene, {}, Cloud::device());
        const pictures::Image image = pile.updateAndDraw(method);
        const std::vector<FactInfo> none;
        Facts facts(none, FactOver::lastFrame);
        method.report(pile.frame(), facts);
        return image.at(image.width / 2, image.height / 2).a;
    };
    // The same depth in 70 puffs and in 70,000.
    const float expected = middleOf(70, 0.05);
    EXPECT_GT(expected, 0.5f);
    try {
        EXPECT_NEAR(middleOf(70'000, 5e-5), expected, 0.002f) << "65,535 puffs would lack 6 % of the depth";
    } catch (const InputError& error) {
        EXPECT_THAT(error.what(), testing::HasSubstr("exact_tiles: got too many puffs"));
        EXPECT_TRUE(Cloud::device().isSoftware());
    }
}

}  // namespace
}  // namespace dustbench::exact_tiles
