// Tests a picture of several grids, and a grid that is shown again in another position and thinner.
#include <gtest/gtest.h>

#include "methods/kit/raycast/raycast_test_canvas.h"

namespace dustbench::raycast {
namespace {

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
