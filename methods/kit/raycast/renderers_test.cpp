// Tests the renderers of a grid against the march and closed forms, the light volume, and pictures of several grids.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "methods/kit/raycast/iso_surface.h"
#include "methods/kit/raycast/raycast_test_canvas.h"

namespace dustbench::raycast {
namespace {

TEST(Renderers, ShowByFineSlicesWhatTheMarchShows) {
    Canvas canvas;
    canvas.setWall(3.217, 50);
    for (const bool burning : {false, true})
        for (const glm::dvec3& eye : {glm::dvec3(3, 2, 4), glm::dvec3(0.3, 0.2, 0.1)}) {
            canvas.lookFrom(eye, -eye);
            RaycastSettings settings = settingsOf(Backend::gl);
            settings.extinctionPerMetre = 4;
            settings.shadowCells = 2;
            settings.asymmetry = 0.5f;
            settings.stepCells = 0.2;
            const pictures::Image march = canvas.picture(lumps(burning), settings);
            settings.renderer = Renderer::slices;
            const pictures::Image slices = canvas.picture(lumps(burning), settings);
            EXPECT_LT(maximumDifference(march, slices), 0.07) << eye.x;
            EXPECT_NEAR(meanAlpha(march) / meanAlpha(slices), 1, 2e-3);
        }
}

TEST(Renderers, ShowBySplatsAlmostWhatTheMarchShows) {
    Canvas canvas;
    canvas.setWall(4.2, 50);
    canvas.lookFrom({3, 2, 4}, {-3, -2, -4});
    for (const bool burning : {false, true}) {
        RaycastSettings settings = settingsOf(Backend::gl);
        settings.extinctionPerMetre = 2;
        settings.shadowCells = burning ? 1 : 0;
        const pictures::Image march = canvas.picture(lumps(burning), settings);
        settings.renderer = Renderer::splat;
        const pictures::Image splats = canvas.picture(lumps(burning), settings);
        double difference = 0, redOfMarch = 0, redOfSplats = 0;
        for (std::size_t i = 0; i < march.pixels.size(); ++i) {
            difference += static_cast<double>(std::abs(march.pixels[i].a - splats.pixels[i].a));
            redOfMarch += static_cast<double>(march.pixels[i].r);
            redOfSplats += static_cast<double>(splats.pixels[i].r);
        }
        // A splat is slightly wider than linear interpolation, and fire in part of a cell fills the whole cell.
        EXPECT_NEAR(meanAlpha(march) / meanAlpha(splats), 1, 0.04);
        EXPECT_NEAR(redOfMarch / redOfSplats, 1, burning ? 0.1 : 0.04);
        EXPECT_LT(difference / static_cast<double>(march.pixels.size()), 0.1 * meanAlpha(march));
    }
}

TEST(IsoSurface, OfABallIsThatBall) {
    const glm::dvec3 middle(0.2, -0.1, 0.3);
    const TestGrid ball({30, 28, 26}, 0.1, {-1.4, -1.5, -1.2},
                        [&](const glm::dvec3& at) { return std::max(0.0, 2 - glm::length(at - middle)); });
    const IsoSurface surface = isoSurface(ball.shown(), 1.2);  // a radius of 0.8
    ASSERT_GT(surface.indices.size(), 3000u);
    double area = 0;
    for (const IsoSurface::Vertex& vertex : surface.vertices) {
        const glm::dvec3 out = glm::dvec3(vertex.place) + ball.originMetres - middle;
        ASSERT_NEAR(glm::length(out), 0.8, 0.005);
        ASSERT_GT(glm::dot(glm::normalize(out), glm::dvec3(vertex.normal)), 0.99);
    }
    for (std::size_t i = 0; i < surface.indices.size(); i += 3) {
        const auto corner = [&](std::size_t k) { return glm::dvec3(surface.vertices[surface.indices[i + k]].place); };
        area += glm::length(glm::cross(corner(1) - corner(0), corner(2) - corner(0))) / 2;
    }
    EXPECT_NEAR(area / (4 * 3.14159265 * 0.64), 1, 0.01);
    EXPECT_TRUE(isoSurface(ball.shown(), 3).indices.empty());
}

TEST(Renderers, ShowAnIsosurfaceAsASolidThatTheSceneHides) {
    Canvas canvas;
    canvas.lights.toSun = {0, 0, 1};
    canvas.lookFrom({0, 0, 5}, {0, 0, -1});
    canvas.setWall(3.5, 48);  // in front of the ball's right half
    const TestGrid ball({20, 20, 20}, 0.2, {-2, -2, -2},
                        [](const glm::dvec3& at) { return 2 / (1 + glm::dot(at, at)); });
    RaycastSettings settings;
    settings.renderer = Renderer::isosurface;
    settings.isoDensity = 1;  // a radius of 1
    const pictures::Image image = canvas.picture(ball, settings);
    double covered = 0;
    for (const glm::vec4& pixel : image.pixels) covered += static_cast<double>(pixel.a);
    // Half a disc, whose rim is where the line of sight is tangent to the ball: tan² = 1/(25 − 1).
    const double pixelsPerSlope = 36 / std::tan(canvas.view.camera.verticalFieldOfView / 2);
    EXPECT_NEAR(covered / (3.14159265 / 48 * pixelsPerSlope * pixelsPerSlope), 1, 0.03);
    const float red = settings.smokeColour.r * (canvas.lights.ambient.r + canvas.lights.sun.r);
    EXPECT_NEAR(image.at(47, 36).r, red, 0.01);
    EXPECT_EQ(image.at(50, 36).a, 0);
}

TEST(LightVolume, OfAHomogeneousBoxIsTheAnalyticOne) {
    // Neither the cells nor the rows of texels are whole multiples.
    const TestGrid box({38, 10, 7}, 0.25, {3, 2, 1}, [](const glm::dvec3&) { return 0.8; });
    for (const glm::dvec3& toSun : {glm::dvec3(-0.48, 0.6, 0.64), glm::dvec3(0, 1, 0), glm::dvec3(0.6, -0.8, 0)}) {
        RaycastSettings settings;
        settings.shadowCells = 2;
        settings.extinctionPerMetre = 0.7;
        MemoryLedger ledger;
        LightVolume light(settings, glm::vec3(toSun), ledger);
        light.set(box.shown());
        ASSERT_EQ(light.texels(), glm::ivec3(19, 5, 4));
        for (int i = 0; i < 19 * 5 * 4; ++i) {
            const glm::dvec3 end = 0.25 * glm::dvec3(box.cells);
            const glm::dvec3 at = glm::min(0.5 * (glm::dvec3(i % 19, i / 19 % 5, i / 95) + 0.5), end);
            double length = 1e9;
            for (int axis = 0; axis < 3; ++axis)
                if (toSun[axis] != 0)
                    length = std::min(length, ((toSun[axis] > 0 ? end[axis] : 0) - at[axis]) / toSun[axis]);
            EXPECT_NEAR(light.values()[static_cast<std::size_t>(i)], std::exp(-0.56 * length), 1e-4) << i;
        }
    }
}

/// Closed forms of a filter's value at a position in cells, for a layer of cells with edges of 1.
double filtered(const TestGrid& layer, Filter filter, const glm::dvec2& place) {
    const auto at = [&](int x, int y) {
        const glm::ivec2 cell = glm::clamp(glm::ivec2(x, y), glm::ivec2(0), glm::ivec2(layer.cells) - 1);
        return static_cast<double>(layer.density[static_cast<std::size_t>(cell.x + layer.cells.x * cell.y)]);
    };
    if (filter == Filter::nearest) return at(static_cast<int>(place.x), static_cast<int>(place.y));
    const glm::dvec2 low = glm::floor(place - 0.5);
    double sum = 0;
    for (int j = -1; j <= 2; ++j)
        for (int i = -1; i <= 2; ++i) {
            const glm::dvec2 away = glm::abs(place - 0.5 - low - glm::dvec2(i, j));
            const auto weight = [&](double d) {
                if (filter == Filter::linear) return std::max(1 - d, 0.0);
                return d < 1 ? 2.0 / 3 - d * d + d * d * d / 2 : std::pow(std::max(2 - d, 0.0), 3) / 6;
            };
            sum += weight(away.x) * weight(away.y) * at(static_cast<int>(low.x) + i, static_cast<int>(low.y) + j);
        }
    return sum;
}

class FiltersOn : public ::testing::TestWithParam<Backend> {};
INSTANTIATE_TEST_SUITE_P(Backends, FiltersOn, ::testing::Values(Backend::cpu, Backend::gl),
                         [](const auto& test) { return test.param == Backend::cpu ? "Cpu" : "Gl"; });

TEST_P(FiltersOn, ShowALayerOfCellsByTheirClosedForms) {
    Canvas canvas;
    canvas.view.camera.verticalFieldOfView = 0.05;  // each ray stays at one position of the layer
    canvas.lookFrom({0, 0, 200}, {0, 0, -1});
    std::mt19937 random(7);
    std::uniform_real_distribution<double> share(0, 1);
    const TestGrid layer({12, 10, 1}, 1, {-6, -5, -0.5}, [&](const glm::dvec3&) { return share(random); });
    for (const Filter filter : {Filter::nearest, Filter::linear, Filter::cubic}) {
        RaycastSettings settings = settingsOf(GetParam());
        settings.filter = filter;
        const pictures::Image image = canvas.picture(layer, settings);
        int seen = 0;
        for (int y = 0; y < image.height; ++y)
            for (int x = 0; x < image.width; ++x) {
                const glm::dvec3 along(canvas.view.rayDirection(x + 0.5, y + 0.5));
                const glm::dvec2 place = 200 / -along.z * glm::dvec2(along) + glm::dvec2(6, 5);
                const glm::dvec2 inCell = glm::fract(place);
                // The layer's front and back are half a cell away, and a ray crosses up to 0.03 of a cell meanwhile.
                if (place.x < 0 || place.y < 0 || place.x > 12 || place.y > 10 ||
                    glm::any(glm::lessThan(glm::min(inCell, 1.0 - inCell), glm::dvec2(0.02))))
                    continue;
                ++seen;
                const double alpha = -std::expm1(-filtered(layer, filter, place) / -along.z);
                ASSERT_NEAR(image.at(x, y).a, alpha, filter == Filter::nearest ? 1e-5 : 2e-3) << x << ',' << y;
            }
        EXPECT_GT(seen, 4000);
    }
}

/// `cells` cells of `grid` from `first` on, with a layer of empty cells around them; cells beyond the grid are also
/// empty.
TestGrid partOf(const TestGrid& grid, const glm::ivec3& first, const glm::ivec3& cells, int rim) {
    TestGrid part(cells + 2 * rim, grid.spacingMetres, grid.originMetres + grid.spacingMetres * glm::dvec3(first - rim),
                  [](const glm::dvec3&) { return 0.0; });
    for (int z = 0; z < cells.z; ++z)
        for (int y = 0; y < cells.y; ++y)
            for (int x = 0; x < cells.x; ++x) {
                const glm::ivec3 from = first + glm::ivec3(x, y, z), to = glm::ivec3(x, y, z) + rim;
                const auto index = [](const glm::ivec3& at, const glm::ivec3& size) {
                    return static_cast<std::size_t>(at.x + size.x * (at.y + size.y * at.z));
                };
                part.density[index(to, part.cells)] = grid.density[index(from, grid.cells)];
            }
    return part;
}

TEST(SeveralGrids, WithEmptyRimsShowWhatOneGridShows) {
    Canvas canvas;
    canvas.setWall(5.2, 50);
    const TestGrid whole = testPlume({40, 24, 24});
    for (const glm::dvec3& eye : {glm::dvec3(3, 2, 4), glm::dvec3(-0.35, 0.2, 6)}) {
        canvas.lookFrom(eye, glm::dvec3(-0.3, 0, 0) - eye);
        for (const Backend backend : {Backend::cpu, Backend::gl})
            for (const Renderer renderer : {Renderer::raycast, Renderer::slices, Renderer::splat})
                for (const Filter filter : {Filter::linear, Filter::cubic}) {
                    if (backend == Backend::cpu && renderer != Renderer::raycast) continue;
                    RaycastSettings settings = settingsOf(backend);
                    settings.renderer = renderer;
                    settings.filter = filter;
                    settings.extinctionPerMetre = 3;
                    settings.stepCells = 0.1;
                    const int rim = filter == Filter::cubic ? 2 : 1;
                    MemoryLedger ledger;
                    GridRaycast left(Canvas::device(), settings, canvas.lights, ledger);
                    GridRaycast right(Beside(), left);
                    left.upload(partOf(whole, {0, 0, 0}, {17, 24, 24}, rim).shown());
                    right.upload(partOf(whole, {17, 0, 0}, {23, 24, 24}, rim).shown());
                    const pictures::Image image = canvas.TestCanvas::picture([&](const gpu::Layer& layer) {
                        SceneDepthCopy depth(layer);
                        left.draw(canvas.view, layer, depth);
                        right.draw(canvas.view, layer, depth);
                    });
                    const pictures::Image expected = canvas.picture(whole, settings);
                    EXPECT_GT(meanAlpha(expected), 0.02);
                    // Splats of one picture are sorted, those of two grids are not; equal colours hide the difference.
                    EXPECT_LT(maximumDifference(image, expected), 4e-3)
                        << static_cast<int>(renderer) << " filter " << static_cast<int>(filter) << " eye " << eye.x;
                }
    }
}

TEST(SeveralGrids, AreShownAgainElsewhereAndThinner) {
    Canvas canvas;
    canvas.setWall(6, 50);
    canvas.lookFrom({3, 2, 4}, {-3, -2, -4});
    TestGrid grid = testPlume({40, 24, 24});
    for (const Backend backend : {Backend::cpu, Backend::gl})
        for (const Renderer renderer : {Renderer::raycast, Renderer::slices, Renderer::splat}) {
            if (backend == Backend::cpu && renderer != Renderer::raycast) continue;
            RaycastSettings settings = settingsOf(backend);
            settings.renderer = renderer;
            settings.extinctionPerMetre = 3;
            MemoryLedger ledger;
            GridRaycast raycast(Canvas::device(), settings, canvas.lights, ledger);
            raycast.upload(grid.shown());
            raycast.change({-2.9, -1.5, -1.2}, 0.25f);
            const pictures::Image image =
                canvas.TestCanvas::picture([&](const gpu::Layer& layer) { raycast.draw(canvas.view, layer); });
            TestGrid moved = grid;
            moved.originMetres = {-2.9, -1.5, -1.2};
            for (float& density : moved.density) density *= 0.25f;
            EXPECT_LT(maximumDifference(image, canvas.picture(moved, settings)), 1e-5) << static_cast<int>(renderer);
            EXPECT_GT(maximumDifference(image, canvas.picture(grid, settings)), 0.05);
        }
}

}  // namespace
}  // namespace dustbench::raycast
