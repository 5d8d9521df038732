#include "methods/offscreen_particles/offscreen_particles.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <string>
#include <vector>

#include "methods/kit/testing/test_moment.h"

namespace dustbench::offscreen_particles {
namespace {

constexpr double wallMetres = 4;  ///< in front of all puffs
constexpr int width = 96, height = 72;

/// Dust in front of an eye, 6 to 26 m away.
class Cloud : public TestMoment {
 public:
    explicit Cloud(std::size_t count, int columns = width, int rows = height)
        : TestMoment(count, columns, rows, {0, 2, 0}, {0, 0, -10}) {
        std::mt19937 random(1);
        std::uniform_real_distribution<float> uniform(0, 1);
        dust.keepOneColour(false);
        for (std::size_t i = 0; i < count; ++i) {
            dust.serial[i] = i;
            dust.x[i] = 8 * uniform(random) - 4;
            dust.y[i] = 4 * uniform(random);
            dust.z[i] = -6 - 20 * uniform(random);
            dust.radius[i] = 0.5f + uniform(random);
            dust.opacity[i] = 0.3f * uniform(random);
            dust.lifetime[i] = 5;
            dust.red[i] = uniform(random), dust.green[i] = uniform(random), dust.blue[i] = uniform(random);
        }
    }
    /// Wide puffs, whose quads reach beyond the picture.
    void makeSmooth() {
        for (std::size_t i = 0; i < dust.size(); ++i)
            dust.radius[i] = 12, dust.z[i] = -10 - 0.1f * static_cast<float>(i);
    }
    pictures::Image drawn(const Settings& settings) {
        OffscreenParticles method(settings);
        method.prepare(scene, {}, device());
        return updateAndDraw(method);
    }
    /// The same puffs drawn directly at this picture's resolution.
    pictures::Image drawnAsBillboards() {
        MemoryLedger ledger;
        draw::DepthSort sort(ledger);
        draw::Billboards quads(device(), {});
        float* value = quads.map(dust.size(), quads.layout(true)).data();
        for (const std::uint32_t i :
             sort.farToNear(draw::SortKind::radix, {dust.x, dust.y, dust.z}, glm::vec3(view.camera.eye)))
            for (const float next : {dust.x[i], dust.y[i], dust.z[i], dust.radius[i], dust.opacity[i], dust.red[i],
                                     dust.green[i], dust.blue[i]})
                *value++ = next;
        quads.unmap();
        return picture([&](const gpu::Layer& layer) { quads.draw(view, {}, layer); });
    }
};

double rootMeanSquare(const pictures::Image& a, const pictures::Image& b) {
    double squares = 0;
    int pixels = 0;
    // Texels that would lie beyond the border are clamped, so the outermost pixels are left out.
    for (int y = 4; y < a.height - 4; ++y)
        for (int x = 4; x < a.width - 4; ++x, ++pixels) {
            const double difference = static_cast<double>(a.at(x, y).a - b.at(x, y).a);
            squares += difference * difference;
        }
    return std::sqrt(squares / pixels);
}

/// One pixel of an enlarged picture, by the formulas: `isLike(column)` selects the texels that take part.
template <typename IsLike>
glm::dvec4 plainEnlarged(const pictures::Image& small, int scale, int x, int y, const IsLike& isLike) {
    const glm::dvec2 place = (glm::dvec2(x, y) + 0.5) / static_cast<double>(scale) - 0.5;
    glm::dvec4 sum(0);
    double total = 0;
    for (int row = static_cast<int>(std::floor(place.y)); row <= std::floor(place.y) + 1; ++row)
        for (int column = static_cast<int>(std::floor(place.x)); column <= std::floor(place.x) + 1; ++column) {
            const int atX = std::clamp(column, 0, small.width - 1), atY = std::clamp(row, 0, small.height - 1);
            if (!isLike(atX)) continue;
            const double share = (1 - std::abs(place.x - column)) * (1 - std::abs(place.y - row));
            sum += share * glm::dvec4(small.at(atX, atY));
            total += share;
        }
    return total > 0 ? sum / total : glm::dvec4(0);
}

/// Linear interpolation is wrong by f″·h²·t(1 − t)/2 between samples h apart: t = 1/4 and 3/4 for scale 2; 1/8, 3/8,
/// 5/8 and 7/8 for scale 4. The root mean squares over t have the ratio 3.9.
TEST(OffscreenParticles, ErrsOverASmoothCloudByTheSecondOrderOfItsScale) {
    Cloud cloud(6);
    cloud.makeSmooth();
    const pictures::Image exact = cloud.drawnAsBillboards();
    ASSERT_GT(exact.at(width / 2, height / 2).a, 0.2f);
    for (const Upsampling upsampling : {Upsampling::depth, Upsampling::bilinear}) {
        const double half = rootMeanSquare(cloud.drawn({2, upsampling, Edges::mixed}), exact);
        const double quarter = rootMeanSquare(cloud.drawn({4, upsampling, Edges::mixed}), exact);
        EXPECT_LT(quarter, 1e-3);
        EXPECT_NEAR(quarter / half, 3.9, 0.2);
    }
    const double half = rootMeanSquare(cloud.drawn({2, Upsampling::nearest, Edges::mixed}), exact);
    const double quarter = rootMeanSquare(cloud.drawn({4, Upsampling::nearest, Edges::mixed}), exact);
    // Root mean squares of the offsets to the nearest sample: 1/2 pixel, and √(5/4) pixels.
    EXPECT_NEAR(quarter / half, std::sqrt(5.0), 0.1);
}

TEST(OffscreenParticles, EnlargesByThePlainFormulasAtASilhouette) {
    for (const int scale : {2, 4}) {
        const int column = width / 2;  // a texel lies on one side
        Cloud cloud(60), small(60, width / scale, height / scale);
        cloud.setWall(wallMetres, column);
        small.setWall(wallMetres, column / scale);
        const pictures::Image texels = small.drawnAsBillboards();
        const pictures::Image depth = cloud.drawn({scale, Upsampling::depth, Edges::none});
        const pictures::Image bilinear = cloud.drawn({scale, Upsampling::bilinear, Edges::none});
        const pictures::Image nearest = cloud.drawn({scale, Upsampling::nearest, Edges::none});
        for (int y = 0; y < height; ++y)
            for (int x = 0; x < width; ++x) {
                const auto sameSide = [&](int texel) { return small.isWalled(texel) == cloud.isWalled(x); };
                const glm::dvec4 expected = plainEnlarged(texels, scale, x, y, sameSide);
                const glm::dvec4 all = plainEnlarged(texels, scale, x, y, [](int) { return true; });
                for (int c = 0; c < 4; ++c) {
                    ASSERT_NEAR(depth.at(x, y)[c], expected[c], 1e-5) << scale << ' ' << x << ' ' << y;
                    ASSERT_NEAR(bilinear.at(x, y)[c], all[c], 1e-5) << scale << ' ' << x << ' ' << y;
                    ASSERT_NEAR(nearest.at(x, y)[c], texels.at(x / scale, y / scale)[c], 1e-5);
                }
            }
    }
}

TEST(OffscreenParticles, CarriesDustAcrossASilhouetteOnlyWithoutDepth) {
    for (const int scale : {2, 4}) {
        Cloud cloud(60);
        cloud.setWall(wallMetres, width / 2);
        const auto mostOnTheWall = [&](Upsampling upsampling) {
            const pictures::Image image = cloud.drawn({scale, upsampling, Edges::none});
            float most = 0;
            for (int y = 0; y < height; ++y)
                for (int x = width / 2; x < width; ++x) most = std::max(most, image.at(x, y).a);
            return most;
        };
        EXPECT_EQ(mostOnTheWall(Upsampling::depth), 0);
        EXPECT_GT(mostOnTheWall(Upsampling::bilinear), 0.05f);
    }
}

/// A wall that begins within texels, which makes them deeper than some of their pixels.
TEST(OffscreenParticles, EqualsBillboardsAtEdgesIfTheyAreMixed) {
    for (const int scale : {2, 4})
        for (int column = width / 2; column < width / 2 + scale; ++column)
            for (const auto& upsampling : upsamplings.all()) {
                Cloud cloud(60);
                cloud.setWall(wallMetres, column);
                const pictures::Image exact = cloud.drawnAsBillboards();
                const pictures::Image mixed = cloud.drawn({scale, upsampling.value, Edges::mixed});
                const pictures::Image none = cloud.drawn({scale, upsampling.value, Edges::none});
                // Texel k is on the wall if all its pixels are.
                const auto walled = [&](int texel) {
                    return cloud.isWalled(std::clamp(texel, 0, width / scale - 1) * scale);
                };
                int edges = 0;
                for (int y = 0; y < height; ++y)
                    for (int x = 0; x < width; ++x) {
                        const int left = static_cast<int>(std::floor((x + 0.5) / scale - 0.5));
                        const bool edge = walled(left) != cloud.isWalled(x) || walled(left + 1) != cloud.isWalled(x);
                        edges += edge ? 1 : 0;
                        const pictures::Image& expected = edge ? exact : none;
                        ASSERT_EQ(mixed.at(x, y), expected.at(x, y)) << scale << ' ' << column << ' ' << x << ' ' << y;
                        if (cloud.isWalled(x)) {
                            ASSERT_EQ(mixed.at(x, y).a, 0);
                        }
                    }
                EXPECT_GE(edges, height * scale);
            }
}

TEST(OffscreenParticles, TakesSizesThatItsScaleDoesNotDivide) {
    for (const int scale : {2, 4}) {
        Cloud cloud(6, 95, 71);
        cloud.makeSmooth();
        EXPECT_LT(rootMeanSquare(cloud.drawn({scale, Upsampling::depth, Edges::mixed}), cloud.drawnAsBillboards()),
                  1e-3);
        Cloud walled(60, 95, 71);
        walled.setWall(wallMetres, 47);
        const pictures::Image image = walled.drawn({scale, Upsampling::depth, Edges::mixed});
        for (int y = 0; y < image.height; ++y)
            for (int x = 47; x < image.width; ++x) ASSERT_EQ(image.at(x, y).a, 0) << x << ' ' << y;
    }
}

TEST(OffscreenParticles, DrawsTheSameAgainAndFollowsACloudThatComesAndGoes) {
    Cloud empty(0), few(20), other(30, 64, 48);
    few.setWall(wallMetres, 41);
    const MethodInfo info = describe();
    const auto method = info.create(ParameterValues(info.parameters));
    method->prepare(few.scene, {}, Cloud::device());
    const pictures::Image first = few.updateAndDraw(*method);
    EXPECT_EQ(few.draw(*method).pixels, first.pixels);
    for (const glm::vec4& pixel : empty.updateAndDraw(*method).pixels) ASSERT_EQ(pixel, glm::vec4(0));
    EXPECT_EQ(method->primitives(), 0);
    (void)other.updateAndDraw(*method);
    EXPECT_EQ(method->primitives(), 30);
    EXPECT_EQ(few.updateAndDraw(*method).pixels, first.pixels);
}

/// 16 bytes of colour and 4 of depth for each texel of the small picture, and for each pixel if edges are mixed.
TEST(OffscreenParticles, ReportsTheBitsOfItsTargets) {
    Cloud cloud(20);
    for (const int scale : {2, 4})
        for (const auto& edges : edgeKinds.all()) {
            OffscreenParticles method({scale, Upsampling::depth, edges.value});
            method.prepare(cloud.scene, {}, Cloud::device());
            (void)cloud.updateAndDraw(method);
            std::size_t bytes = 0;
            for (const MemoryUse& use : method.memory())
                if (use.structure == "targets") bytes = use.gpuBytes;
            const int texels = width * height / (scale * scale) + (edges.value == Edges::mixed ? width * height : 0);
            EXPECT_EQ(bytes, static_cast<std::size_t>(20 * texels));
        }
}

}  // namespace
}  // namespace dustbench::offscreen_particles
