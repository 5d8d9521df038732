#include "methods/kit/draw/tile_billboards.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <stdexcept>
#include <vector>

#include "methods/contract/volume.h"
#include "methods/kit/draw/test_canvas.h"

namespace dustbench::draw {
namespace {

struct TilePuff {
    glm::vec3 fromEye;
    float radius, opacity;
    glm::vec3 colour{1};
};
using TilePuffs = std::vector<TilePuff>;

/// A picture of the same puffs in both ways.
class TileCanvas : public TestCanvas {
 public:
    TileCanvas(int width = 160, int height = 120)
        : TestCanvas(width, height, {100.5, 2.25, -40.125}, {0.2, -0.1, -1}) {}

    void put(Billboards& billboards, const TilePuffs& puffs, bool coloured) const {
        float* value = billboards.map(puffs.size(), billboards.layout(coloured)).data();
        for (const TilePuff& puff : puffs) {
            const glm::vec3 place = at(puff.fromEye);
            for (const float next : {place.x, place.y, place.z, puff.radius, puff.opacity}) *value++ = next;
            for (int i = 0; coloured && i < 3; ++i) *value++ = puff.colour[i];
        }
        billboards.unmap();
    }
    pictures::Image byHardware(Billboards& billboards) {
        return picture([&](const gpu::Layer& layer) { billboards.draw(view, colourOfAll, layer); });
    }
    pictures::Image byTiles(const Billboards& billboards, TileBillboards& tiles) {
        return picture(
            [&](const gpu::Layer& layer) { tiles.draw(billboards, view, colourOfAll, layer, StageClock()); });
    }

    glm::vec3 colourOfAll{0.5f, 0.25f, 0.125f};
};

/// `fromEye` within `low` and `high`, radii between `least` and `most` with as many in each octave.
TilePuffs randomPuffs(std::size_t count, glm::vec3 low, glm::vec3 high, float least, float most,
                      float mostOpacity = 0.2f) {
    std::mt19937 random(static_cast<std::uint32_t>(count));
    std::uniform_real_distribution<float> uniform(0, 1);
    const auto vector = [&] {  // in this order with every compiler
        const std::array<float, 3> next{uniform(random), uniform(random), uniform(random)};
        return glm::vec3(next[0], next[1], next[2]);
    };
    TilePuffs puffs;
    for (std::size_t i = 0; i < count; ++i)
        puffs.push_back({glm::mix(low, high, vector()), least * std::pow(most / least, uniform(random)),
                         mostOpacity * uniform(random), vector()});
    return puffs;
}

/// Whether a puff's quad covers this point of the picture, in pixels.
bool covers(const TileCanvas& canvas, const TilePuff& puff, Facing facing, double x, double y) {
    const glm::dmat4 clip(canvas.view.eyeToClip());
    const glm::dvec3 centre =
        glm::dmat3(canvas.view.worldToEye()) * (glm::dvec3(canvas.at(puff.fromEye)) - canvas.view.camera.eye);
    const glm::dvec3 normal = facing == Facing::viewplane ? glm::dvec3(0, 0, -1) : glm::normalize(centre);
    const glm::dvec3 right = glm::normalize(glm::dvec3(-normal.z, 0, normal.x)), up = glm::cross(right, normal);
    const glm::dvec3 ray((2 * x / canvas.view.width - 1) / clip[0][0], (1 - 2 * y / canvas.view.height) / clip[1][1],
                         -1);
    const double along = glm::dot(centre, normal) / glm::dot(ray, normal);
    const glm::dvec3 offset = ray * along - centre;
    const double side = std::max(std::abs(glm::dot(offset, right)), std::abs(glm::dot(offset, up)));
    return along >= canvas.view.camera.nearMetres && side <= 1.5 * static_cast<double>(puff.radius);
}

/// Whether the edge of a puff's quad passes within 1/100 pixel of a pixel's centre.
bool isAtAnEdge(const TileCanvas& canvas, const TilePuffs& puffs, Facing facing, int x, int y) {
    return std::ranges::any_of(puffs, [&](const TilePuff& puff) {
        const bool covered = covers(canvas, puff, facing, x + 0.5, y + 0.5);
        for (const double dx : {-0.01, 0.01})
            for (const double dy : {-0.01, 0.01})
                if (covers(canvas, puff, facing, x + 0.5 + dx, y + 0.5 + dy) != covered) return true;
        return false;
    });
}

/// By how many times positions on the puffs over a pixel are coarser than on quads of four pixels. Hardware computes
/// them from corners in floats, whose steps are a larger part of a smaller quad.
double coarseness(const TileCanvas& canvas, const TilePuffs& puffs, Facing facing, int x, int y) {
    const double pixelsAtOneMetre = static_cast<double>(canvas.view.eyeToClip()[1][1]) * canvas.view.height / 2;
    double coarsest = 1;
    for (const TilePuff& puff : puffs) {
        const double halfPixels =
            1.5 * static_cast<double>(puff.radius) * pixelsAtOneMetre / static_cast<double>(glm::length(puff.fromEye));
        if (halfPixels < 2 && covers(canvas, puff, facing, x + 0.5, y + 0.5))
            coarsest = std::max(coarsest, 2 / halfPixels);
    }
    return coarsest;
}

/// Hardware places corners in steps of 1/256 pixel, and cuts quads at the picture's border in its own way: a pixel
/// whose centre is at an edge may differ. GPUs other than llvmpipe also interpolate between the corners in these steps.
void expectSame(const pictures::Image& tiles, const pictures::Image& hardware, const TileCanvas& canvas,
                const TilePuffs& puffs, Facing facing, const std::string& what) {
    const double tolerance = TestCanvas::device().isSoftware() ? 1e-5 : 1e-2;
    ASSERT_EQ(tiles.pixels.size(), hardware.pixels.size());
    std::size_t atEdges = 0;
    double light = 0;
    for (int y = 0; y < tiles.height; ++y)
        for (int x = 0; x < tiles.width; ++x) {
            const glm::vec4 difference = glm::abs(tiles.at(x, y) - hardware.at(x, y));
            const float largest = std::max({difference.r, difference.g, difference.b, difference.a});
            light += static_cast<double>(hardware.at(x, y).a);
            if (static_cast<double>(largest) <= tolerance ||
                static_cast<double>(largest) <= tolerance * coarseness(canvas, puffs, facing, x, y))
                continue;
            ASSERT_TRUE(isAtAnEdge(canvas, puffs, facing, x, y)) << what << ": " << largest << " at " << x << ',' << y;
            ASSERT_LT(largest, 0.02f) << what << ": " << x << ',' << y;
            ++atEdges;
        }
    EXPECT_LE(atEdges, 1 + tiles.pixels.size() / 100) << what;
    EXPECT_GT(light, 0) << what;
}

struct NamedStyle {
    const char* name;
    BillboardStyle style;
};
constexpr std::array<NamedStyle, 4> tileStyles{
    {{"viewpoint", {}},
     {"viewplane", {.facing = Facing::viewplane}},
     {"soft", {.soft = true}},
     {"soft plain viewplane", {.facing = Facing::viewplane, .soft = true, .plainAlpha = true}}}};

/// Puffs in front of the eye, of one colour and of several, and a cloud around it: behind the eye, cut by the near
/// plane, and larger than the picture.
TEST(TileBillboards, DrawTheHardwaresPictureInEveryStyle) {
    const TilePuffs ahead = randomPuffs(400, {-6, -4, -25}, {6, 4, -4}, 0.1f, 2);
    TilePuffs around = randomPuffs(300, {-3, -3, -3}, {3, 3, 3}, 0.02f, 1.5f, 0.1f);
    around.push_back({{0, 0, 0}, 1, 0.5f});
    around.push_back({{0, 1, -30}, 200, 0.2f, {1, 0, 0}});
    for (const auto& [name, style] : tileStyles) {
        TileCanvas canvas;
        Billboards billboards(TileCanvas::device(), style);
        TileBillboards tiles(TileCanvas::device(), style);
        const auto expectSamePicture = [&](const TilePuffs& puffs, bool coloured) {
            canvas.put(billboards, puffs, coloured);
            expectSame(canvas.byTiles(billboards, tiles), canvas.byHardware(billboards), canvas, puffs, style.facing,
                       name);
        };
        expectSamePicture(around, true);
        canvas.setWall(12, 70);
        expectSamePicture(ahead, false);
        expectSamePicture(ahead, true);
    }
}

TEST(TileBillboards, DrawTheHardwaresPictureInEverySize) {
    const TilePuffs puffs = randomPuffs(300, {-6, -4, -25}, {6, 4, -4}, 0.1f, 2);
    Billboards billboards(TileCanvas::device(), {});
    TileBillboards tiles(TileCanvas::device(), {});
    for (const auto& [width, height] :
         {std::pair{161, 119}, {8, 8}, {9, 7}, {1, 1}, {33, 300}, {400, 17}, {160, 120}}) {
        TileCanvas canvas(width, height);
        canvas.put(billboards, puffs, true);
        expectSame(canvas.byTiles(billboards, tiles), canvas.byHardware(billboards), canvas, puffs, Facing::viewpoint,
                   std::to_string(width) + "x" + std::to_string(height));
    }
}

/// From less than a pixel to many times the picture: each level of tiles has some.
TEST(TileBillboards, DrawTheHardwaresPictureOfPuffsOfAllSizes) {
    TileCanvas canvas(320, 240);
    TilePuffs puffs = randomPuffs(2'000, {-12, -8, -40}, {12, 8, -15}, 0.01f, 0.5f, 0.3f);
    const TilePuffs large = randomPuffs(60, {-12, -8, -40}, {12, 8, -20}, 1, 60, 0.1f);
    for (std::size_t i = 0; i < large.size(); ++i)
        puffs.insert(puffs.begin() + static_cast<std::ptrdiff_t>(30 * i), large[i]);
    Billboards billboards(TileCanvas::device(), {});
    TileBillboards tiles(TileCanvas::device(), {});
    canvas.put(billboards, puffs, true);
    expectSame(canvas.byTiles(billboards, tiles), canvas.byHardware(billboards), canvas, puffs, Facing::viewpoint,
               "all sizes");
}

/// Corners on pixel centres: each pixel belongs to one of two quads with a common edge.
TEST(TileBillboards, CoverPixelsAtTheirEdgesAsHardwareDoes) {
    TileCanvas canvas(64, 64);
    canvas.lookFrom({0, 0, 0}, {0, 0, -1});
    const float perMetre = canvas.view.eyeToClip()[1][1] * 32 / 8;  // pixels, at a distance of 8 m
    TilePuffs puffs;
    for (int row = -3; row < 3; ++row)
        for (int column = -3; column < 3; ++column)
            puffs.push_back({{(8.5f * static_cast<float>(column) + 0.25f) / perMetre,
                              (8.5f * static_cast<float>(row) + 0.75f) / perMetre, -8},
                             8.5f / perMetre / 3,
                             0.99f,
                             {0.1f * static_cast<float>(row + 3), 1, 0}});
    const BillboardStyle style{.facing = Facing::viewplane};
    Billboards billboards(TileCanvas::device(), style);
    TileBillboards tiles(TileCanvas::device(), style);
    canvas.put(billboards, puffs, true);
    expectSame(canvas.byTiles(billboards, tiles), canvas.byHardware(billboards), canvas, {}, Facing::viewplane,
               "edges");
}

/// More puffs in a tile than are merged at once, near enough to opaque to end early, and in an order that shows.
TEST(TileBillboards, KeepTheOrderOfManyPuffsInATile) {
    TileCanvas canvas(40, 40);
    canvas.lookFrom({0, 0, 0}, {0, 0, -1});
    for (const float opacity : {0.002f, 0.05f, 0.9f}) {
        const TilePuffs puffs = randomPuffs(3'000, {-0.5f, -0.5f, -9}, {0.5f, 0.5f, -8}, 0.3f, 3, opacity);
        Billboards billboards(TileCanvas::device(), {});
        TileBillboards tiles(TileCanvas::device(), {});
        canvas.put(billboards, puffs, true);
        expectSame(canvas.byTiles(billboards, tiles), canvas.byHardware(billboards), canvas, puffs, Facing::viewpoint,
                   std::to_string(opacity));
    }
}

/// Dust in GPU buffers, whose number only the GPU knows.
struct GpuCloud {
    GpuCloud(const TileCanvas& canvas, const TilePuffs& puffs, std::uint32_t bound, bool coloured) {
        std::vector<float> positions, looks, colours;
        for (const TilePuff& puff : puffs)
            for (int i = 0; i < 3; ++i) {
                positions.push_back(canvas.at(puff.fromEye)[i]);
                colours.push_back(puff.colour[i]);
                if (i < 2) looks.push_back(i == 0 ? puff.radius : puff.opacity);
            }
        const auto count = static_cast<std::uint32_t>(puffs.size());
        position = filled(positions, 3 * bound), look = filled(looks, 2 * bound), colour = filled(colours, 3 * bound);
        tally = filled(std::vector<std::uint32_t>{count, (count + 255) / 256, 1, 1}, 4);
        dust.position = &position, dust.look = &look, dust.tally = &tally;
        if (coloured) dust.colour = &colour;
        dust.bound = bound;
    }

    gpu::Buffer position, look, colour, tally;
    GpuPuffs dust;

 private:
    template <typename T>
    static gpu::Buffer filled(const std::vector<T>& values, std::size_t room) {
        gpu::Buffer buffer(TileCanvas::device(), "dust", std::max<std::size_t>(room, 4) * sizeof(T));
        buffer.write(std::span<const T>(values));
        return buffer;
    }
};

TEST(TileBillboards, DrawDustWhoseNumberOnlyTheGpuKnows) {
    TileCanvas canvas;
    Billboards onCpu(TileCanvas::device(), {}), gathered(TileCanvas::device(), {});
    TileBillboards tiles(TileCanvas::device(), {});
    for (const bool coloured : {false, true})
        for (const std::size_t count : {300u, 1u, 0u, 6'000u, 0u, 257u}) {
            const TilePuffs puffs = randomPuffs(count, {-6, -4, -25}, {6, 4, -4}, 0.1f, 1, 0.05f);
            const GpuCloud cloud(canvas, puffs, 9'000, coloured);
            canvas.put(onCpu, puffs, coloured);
            gathered.gather(cloud.dust);
            EXPECT_EQ(canvas.byTiles(gathered, tiles).pixels, canvas.byTiles(onCpu, tiles).pixels) << count;
            if (count > 0)
                expectSame(canvas.byTiles(gathered, tiles), canvas.byHardware(gathered), canvas, puffs,
                           Facing::viewpoint, std::to_string(count));
        }
}

TEST(TileBillboards, DrawTheSameAgainAndNothingWithoutPuffs) {
    TileCanvas canvas;
    Billboards billboards(TileCanvas::device(), {});
    TileBillboards tiles(TileCanvas::device(), {});
    const TilePuffs puffs = randomPuffs(500, {-6, -4, -25}, {6, 4, -4}, 0.1f, 2);
    canvas.put(billboards, puffs, false);
    const pictures::Image first = canvas.byTiles(billboards, tiles);
    EXPECT_EQ(canvas.byTiles(billboards, tiles).pixels, first.pixels);
    const std::size_t bytes = tiles.bytes();
    for (const TilePuffs& none :
         {TilePuffs{}, TilePuffs(70, TilePuff{{0, 0, 9}, 1, 0.5f}), TilePuffs(70, TilePuff{{90, 0, -9}, 1, 0.5f}),
          TilePuffs(70, TilePuff{{0, 0, -9}, 0, 1})}) {
        canvas.put(billboards, none, false);
        for (const glm::vec4& pixel : canvas.byTiles(billboards, tiles).pixels) ASSERT_EQ(pixel, glm::vec4(0));
    }
    canvas.put(billboards, puffs, false);
    EXPECT_EQ(canvas.byTiles(billboards, tiles).pixels, first.pixels);
    EXPECT_EQ(tiles.bytes(), bytes);
}

TEST(TileBillboards, RefuseStylesOfOtherMethods) {
    EXPECT_THROW(TileBillboards(TileCanvas::device(), {.additive = true}), std::invalid_argument);
    EXPECT_THROW(TileBillboards(TileCanvas::device(), {.moving = true}), std::invalid_argument);
}

}  // namespace
}  // namespace dustbench::draw
