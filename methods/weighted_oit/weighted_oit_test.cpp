#include "methods/weighted_oit/weighted_oit.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include "methods/contract/errors.h"
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
    pictures::Image drawn(Settings settings) {
        settings.reachDeviations = wide;
        WeightedOit method(settings);
        method.prepare(scene, {}, device());
        return updateAndDraw(method);
    }
    /// One pixel's depth of one puff.
    [[nodiscard]] double depthOf(std::size_t i, const glm::dvec3& ray, double sceneMetres, double eyeMetres = 0) const {
        const glm::dvec3 centre = glm::dvec3(dust.position(i)) - view.camera.eye;
        return maths::rayOpticalDepth(static_cast<double>(dust.opacity[i]), static_cast<double>(dust.radius[i]),
                                      glm::length(glm::cross(centre, ray)), glm::dot(centre, ray), eyeMetres,
                                      sceneMetres);
    }
    /// The fragments of a pixel in the order of the puffs.
    [[nodiscard]] std::vector<Fragment> fragmentsAt(int x, int y, Puff kind) {
        const glm::dvec3 ray = view.rayDirection(x + 0.5, y + 0.5);
        const glm::dvec3 ahead = glm::normalize(view.camera.target - view.camera.eye);
        const double scene = sceneAt(x, y, ray), slope = glm::dot(ray, ahead);
        std::vector<Fragment> fragments;
        for (std::size_t i = 0; i < dust.size(); ++i) {
            const glm::dvec3 centre = glm::dvec3(dust.position(i)) - view.camera.eye;
            const double infinite = std::numeric_limits<double>::infinity();
            const bool surface = kind == Puff::surface;
            const double axis =
                surface ? glm::dot(centre, ahead) : std::clamp(glm::dot(centre, ray), 0., scene) * slope;
            const bool visible = !surface || (axis > view.camera.nearMetres && axis / slope <= scene);
            const double depth = surface ? depthOf(i, ray, infinite, -infinite) : depthOf(i, ray, scene);
            if (visible && depth > 0) fragments.push_back({axis, depth, glm::dvec3(dust.colour(i))});
        }
        return fragments;
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
        const pictures::Image image = cloud.drawn({.weight = choice.value});
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
            const pictures::Image image = square.drawn({.weight = choice.value});
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
    const pictures::Image a = cloud.drawn({}), b = reversed.drawn({});
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

/// Error of Π(1 − α) after n fragments. OpenGL may round α to the target's format before it blends, and may cut off
/// instead of rounding. 8 bits: each fragment adds at most (R + 1)/510 and scales earlier errors by 1 − α. Half
/// precision: 2⁻¹⁰ of R for each of both roundings, and a step of the smallest numbers.
double revealageBound(Revealage format, const std::vector<Fragment>& fragments) {
    double bound = 0, product = 1;
    for (const Fragment& fragment : fragments) {
        const double passed = std::exp(-fragment.opticalDepth);
        const bool bytes = format == Revealage::r8;
        bound = passed * bound + (bytes ? (product + 1) / 510 : std::ldexp(2 * product, -10) + std::ldexp(1, -24));
        product *= passed;
    }
    return (format == Revealage::r32f ? 0 : bound) + 2e-5;
}

double alphaOf(const std::vector<Fragment>& fragments) {
    double depth = 0;
    for (const Fragment& fragment : fragments) depth += fragment.opticalDepth;
    return -std::expm1(-depth);
}

/// n puffs of one opacity along the camera's axis, from 8 m on.
struct Stack : Cloud {
    Stack(std::size_t count, float opacity) : Cloud(count, false) {
        const glm::vec3 ahead = glm::vec3(glm::normalize(view.camera.target - view.camera.eye));
        for (std::size_t i = 0; i < count; ++i)
            place(i, at((8 + 0.01f * static_cast<float>(i)) * ahead), 1, opacity, {0.6f, 0.4f, 0.2f});
    }
};

constexpr std::array<Revealage, 3> allRevealages{Revealage::r32f, Revealage::r16f, Revealage::r8};

TEST(WeightedOit, HasTheAlphaOfTheProductWithinEachFormatsRounding) {
    for (const float opacity : {0.7f, 0.2f, 0.03f, 0.004f})
        for (const std::size_t count : {1, 2, 5, 20, 100, 400}) {
            Stack stack(count, opacity);
            const auto fragments = stack.fragmentsAt(48, 36, Puff::volume);
            ASSERT_EQ(fragments.size(), count);
            for (const Revealage revealage : allRevealages)
                EXPECT_NEAR(stack.drawn({.revealage = revealage}).at(48, 36).a, alphaOf(fragments),
                            revealageBound(revealage, fragments))
                    << opacity << ' ' << count << ' ' << revealages.wordOf(revealage);
        }
}

/// A step of α·R below half of 1/255 rounds back to R, so that R stays at the last k/255 with k·α ≥ ½.
TEST(WeightedOit, StopsShortOfOpaqueInEightBitsAtTheClosedForm) {
    for (const float opacity : {0.2f, 0.1f, 0.05f, 0.03f}) {
        Stack stack(800, opacity);
        const auto fragments = stack.fragmentsAt(48, 36, Puff::volume);
        ASSERT_GT(alphaOf(fragments), 1 - 1e-9);
        const double stays = std::floor(1 / (2 * static_cast<double>(opacity))) / 255;
        EXPECT_NEAR(plainPixel({.revealage = Revealage::r8}, fragments, 0.1).a, 1 - stays, 1.01 / 255);
        EXPECT_NEAR(stack.drawn({.revealage = Revealage::r8}).at(48, 36).a, 1 - stays, 2.01 / 255);
        EXPECT_NEAR(stack.drawn({.revealage = Revealage::r16f}).at(48, 36).a, 1, 1e-3);
    }
}

TEST(WeightedOit, EqualsThePlainVersionInEveryFormat) {
    for (const Puff puff : {Puff::volume, Puff::surface})
        for (const Accumulation accumulation : {Accumulation::rgba32f, Accumulation::rgba16f})
            for (const Revealage revealage : allRevealages) {
                Cloud cloud(60, false, 5);
                cloud.setGround(1.7);
                const Settings settings{
                    .weight = Weight::eq8, .accumulation = accumulation, .revealage = revealage, .puff = puff};
                const pictures::Image image = cloud.drawn(settings);
                double most = 0;
                for (int y = 2; y < image.height; y += 9)
                    for (int x = 1; x < image.width; x += 7) {
                        const auto fragments = cloud.fragmentsAt(x, y, puff);
                        const glm::dvec4 plain = plainPixel(settings, fragments, cloud.view.camera.nearMetres);
                        // Two sums, each rounded or cut off once per fragment.
                        const double mean = accumulation == Accumulation::rgba32f
                                                ? 2e-5
                                                : std::ldexp(2.0 * static_cast<double>(fragments.size()), -10) + 1e-3;
                        const double alpha = 2 * revealageBound(revealage, fragments);
                        ASSERT_NEAR(image.at(x, y).a, plain.a, alpha) << x << ' ' << y;
                        for (int c = 0; c < 3; ++c) ASSERT_NEAR(image.at(x, y)[c], plain[c], alpha + mean * plain.a);
                        most = std::max(most, plain.a);
                    }
                EXPECT_GT(most, 0.5);
            }
}

/// Weights of 3000 α and colours of 40: the sums exceed 65504 after a few puffs.
TEST(WeightedOit, EndsAtTheLargestHalfWhereSumsOverflow) {
    constexpr std::size_t count = 200;
    Cloud bright(count, false);
    const glm::vec3 ahead = glm::vec3(glm::normalize(bright.view.camera.target - bright.view.camera.eye));
    for (std::size_t i = 0; i < count; ++i) bright.place(i, bright.at(0.4f * ahead), 0.2f, 0.6f, {40, 1, 0.01f});
    const auto fragments = bright.fragmentsAt(48, 36, Puff::volume);
    const Settings half{.accumulation = Accumulation::rgba16f};
    glm::dvec3 sum(0);
    for (const Fragment& fragment : fragments) {
        const double alpha = -std::expm1(-fragment.opticalDepth);
        sum += alpha * plainWeight(half.weight, fragment.axisMetres, alpha, 0.1) * fragment.colour;
    }
    ASSERT_GT(sum.r, 20 * largestHalf);
    ASSERT_GT(sum.g, 1.2 * largestHalf);
    ASSERT_LT(sum.b, largestHalf);
    const pictures::Image image = bright.drawn(half);
    const glm::vec4 pixel = image.at(48, 36);
    EXPECT_NEAR(pixel.r, 1, 1e-3);
    EXPECT_NEAR(pixel.g, 1, 1e-3);
    EXPECT_NEAR(pixel.b, sum.b / largestHalf, 0.1 * sum.b / largestHalf);
    EXPECT_NEAR(pixel.a, 1, 1e-6);
    const glm::dvec4 plain = plainPixel(half, fragments, 0.1);
    for (int c = 0; c < 4; ++c) EXPECT_NEAR(pixel[c], plain[c], 1e-3);
    for (const glm::vec4& any : image.pixels)
        for (int c = 0; c < 4; ++c) ASSERT_TRUE(std::isfinite(any[c]));
    EXPECT_NEAR(bright.drawn({}).at(48, 36).r, 40, 0.01);
}

/// A surface is either whole or hidden, as its centre is in front of or behind the ground.
TEST(WeightedOit, HidesASurfaceByItsCentre) {
    Cloud one(1, false);
    one.setGround(1.7);
    const glm::vec3 eye = glm::vec3(one.view.camera.eye);
    const glm::vec3 ahead = glm::vec3(glm::normalize(one.view.camera.target - one.view.camera.eye));
    const double ground = one.sceneAt(48, 36, one.view.rayDirection(48.5, 36.5));
    for (const float share : {0.95f, 1.05f}) {
        one.place(0, eye + share * static_cast<float>(ground) * ahead, 2, 0.5f, {1, 1, 1});
        const double volume = one.drawn({}).at(48, 36).a, surface = one.drawn({.puff = Puff::surface}).at(48, 36).a;
        EXPECT_NEAR(surface, share < 1 ? 0.5 : 0, 0.01);
        EXPECT_GT(volume, 0.05);
        EXPECT_LT(volume, 0.45);
    }
}

TEST(WeightedOit, DoesNotDependOnTheOrderWithinEachFormatsRounding) {
    Cloud cloud(60, false, 3), reversed(60, false, 3);
    for (std::size_t i = 0; i < 60; ++i)
        reversed.place(i, cloud.dust.position(59 - i), cloud.dust.radius[59 - i], cloud.dust.opacity[59 - i],
                       cloud.dust.colour(59 - i));
    for (const Revealage revealage : {Revealage::r16f, Revealage::r8}) {
        const pictures::Image a = cloud.drawn({.revealage = revealage}), b = reversed.drawn({.revealage = revealage});
        for (int y = 0; y < a.height; y += 3)
            for (int x = 0; x < a.width; x += 3)
                ASSERT_NEAR(a.at(x, y).a, b.at(x, y).a,
                            2 * revealageBound(revealage, cloud.fragmentsAt(x, y, Puff::volume)));
    }
}

TEST(WeightedOit, BlendsAsPublishedInModePaper) {
    const MethodInfo info = describe();
    ParameterValues fixed(info.parameters), paper(info.parameters);
    paper.set("mode", "paper");
    const auto bits = [&](const ParameterValues& values) {
        const auto method = info.create(values);
        Cloud few(5, false);
        method->prepare(few.scene, {}, Cloud::device());
        (void)few.updateAndDraw(*method);
        Facts facts(info.facts, FactOver::lastFrame);
        method->report(few.frame(), facts);
        std::int64_t bytes = 0;
        for (const MemoryUse& use : method->memory())
            if (use.structure == "weighted sums") bytes = static_cast<std::int64_t>(use.gpuBytes);
        const auto reported = std::get<std::int64_t>(facts.value("bits_per_pixel").value());
        EXPECT_EQ(8 * bytes, 96 * 72 * reported);
        EXPECT_EQ(std::get<std::int64_t>(facts.value("bytes_per_fragment").value()), reported / 4) << "added to once";
        return reported;
    };
    EXPECT_EQ(bits(fixed), 160);
    EXPECT_EQ(bits(paper), 72);
    EXPECT_EQ(paper.choice("puff"), "surface");
    EXPECT_EQ(paper.choice("revealage"), "r8");
    paper.set("revealage", "r16f");
    EXPECT_EQ(bits(paper), 80);
}

/// Around the eye, before and behind a wall. Quads of 6 standard deviations, so that nothing is seen at their edges.
TEST(WeightedOit, DrawsTheSamePictureInTiles) {
    for (const bool oneColour : {false, true}) {
        Cloud cloud(300, oneColour);
        cloud.setWall(9, 40);
        for (const Settings& settings : {Settings{}, Settings{.weight = Weight::none, .puff = Puff::surface}}) {
            Settings inTiles = settings;
            inTiles.raster = Raster::tiles;
            const pictures::Image hardware = cloud.drawn(settings), tiles = cloud.drawn(inTiles);
            double alpha = 0;
            for (std::size_t i = 0; i < tiles.pixels.size(); ++i) {
                for (int c = 0; c < 4; ++c) ASSERT_NEAR(tiles.pixels[i][c], hardware.pixels[i][c], 1e-5) << i;
                alpha += static_cast<double>(tiles.pixels[i].a);
            }
            EXPECT_GT(alpha, 1000);
        }
    }
    Cloud nothing(0, true);
    for (const glm::vec4& pixel : nothing.drawn({.raster = Raster::tiles}).pixels) ASSERT_EQ(pixel, glm::vec4(0));
    EXPECT_THROW(WeightedOit({.accumulation = Accumulation::rgba16f, .raster = Raster::tiles}), InputError);
    EXPECT_THROW(WeightedOit({.revealage = Revealage::r8, .raster = Raster::tiles}), InputError);
}

/// llvmpipe of Mesa 22 ends the loops of an invocation after 65,535 iterations: unnoticed, pixels would show a part of
/// the puffs. Mesa 25 does not.
TEST(WeightedOit, InTilesShowsAllPuffsOfAPixelOrSaysThatItCannot) {
    Cloud pile(70'000, false);
    for (std::size_t i = 0; i < pile.dust.size(); ++i) {
        pile.dust.x[i] = 0.8f, pile.dust.y[i] = 0.8f, pile.dust.z[i] = -8;
        pile.dust.radius[i] = 2, pile.dust.opacity[i] = 5e-5f;
    }
    const MethodInfo info = describe();
    std::vector<float> middles;
    for (const Raster raster : {Raster::hardware, Raster::tiles}) {
        WeightedOit method({.raster = raster});
        method.prepare(pile.scene, {}, Cloud::device());
        const pictures::Image image = pile.updateAndDraw(method);
        middles.push_back(image.at(image.width / 2, image.height / 2).a);
        Facts facts(info.facts, FactOver::lastFrame);
        try {
            method.report(pile.frame(), facts);
        } catch (const InputError& error) {
            EXPECT_THAT(error.what(), testing::HasSubstr("weighted_oit: got too many puffs"));
            EXPECT_TRUE(raster == Raster::tiles && Cloud::device().isSoftware());
            return;
        }
    }
    EXPECT_GT(middles.at(0), 0.5f);
    EXPECT_NEAR(middles.at(1), middles.at(0), 0.002f) << "65,535 puffs would lack 6 % of the depth";
}

}  // namespace
}  // namespace dustbench::weighted_oit
