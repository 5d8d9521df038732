// Tests that the border between a fluid's box and its trail is invisible.
#include "methods/grid_fluid/trail_picture.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>

#include "methods/kit/draw/test_canvas.h"

namespace dustbench::grid_fluid {
namespace {

/// Evenly filled, and continued beyond its side towards −x in a lattice that the wind has moved.
struct EvenDust {
    explicit EvenDust(float windMetresPerSecond) : trail({h, {windMetresPerSecond, 0, 0}, 0}, ledger.account("trail")) {
        trail.pass(1);
        for (int i = 1; i <= 20; ++i)
            for (int j = 0; j < cells.y; ++j)
                for (int k = 0; k < cells.z; ++k) {
                    const glm::dvec3 corner = h * glm::dvec3(-i, j, k) + origin;
                    trail.add({corner, corner + h}, h * h * h);
                }
        trail.settle();
    }
    [[nodiscard]] raycast::ShownGrid box() const { return {cells, h, origin, density, {}}; }

    static constexpr double h = 0.1;
    glm::ivec3 cells{40, 16, 16};
    glm::dvec3 origin{0, 0, -0.8};
    std::vector<float> density = std::vector<float>(static_cast<std::size_t>(40 * 16 * 16), 1.0f);
    MemoryLedger ledger;
    DustTrail trail;
};

TEST(TrailPicture, ShowsNoBorderBetweenBoxAndTrailHoweverTheirLatticesLie) {
    // Looks along the border, where it would be most visible.
    draw::TestCanvas canvas(480, 240, {0, 0.8, 8}, {0, 0, -1});
    for (const float wind : {0.0f, 0.03f, 0.05f, -0.08f})
        for (const raycast::Renderer renderer : {raycast::Renderer::raycast, raycast::Renderer::slices}) {
            EvenDust dust(wind);
            raycast::RaycastSettings settings;
            settings.backend = raycast::Backend::gl;
            settings.renderer = renderer;
            settings.stepCells = 0.25;
            raycast::GridRaycast box(draw::TestCanvas::device(), settings, {}, dust.ledger);
            TrailPicture picture(box, settings, {0, 1, 0}, true);
            picture.show(dust.trail, dust.box());
            const pictures::Image image =
                canvas.picture([&](const gpu::Layer& layer) { picture.draw(canvas.view, layer); });
            const pictures::Image again =
                canvas.picture([&](const gpu::Layer& layer) { picture.draw(canvas.view, layer); });
            EXPECT_EQ(image.pixels, again.pixels);
            // Within 1 m of the border, which is in the middle, all rays pass through 1.6 m.
            std::vector<float> depths;
            for (int x = 0; x < 480; ++x) {
                const double atDust = glm::dvec3(canvas.view.rayDirection(x + 0.5, 120.5)).x * 8;
                if (std::abs(atDust) < 1)
                    depths.push_back(-std::log1p(-image.pixels[static_cast<std::size_t>(120 * 480 + x)].a));
            }
            ASSERT_GT(depths.size(), 20u);
            const float mean = std::accumulate(depths.begin(), depths.end(), 0.0f) / static_cast<float>(depths.size());
            EXPECT_NEAR(mean, 1.6, 0.05);
            for (const float depth : depths) EXPECT_NEAR(depth / mean, 1, 0.035) << wind;  // 0.25 where neither fades
        }
}

TEST(TrailPicture, LendsWhatTheBoxNoLongerShows) {
    EvenDust dust(0.03f);
    raycast::RaycastSettings settings;
    settings.backend = raycast::Backend::gl;
    raycast::GridRaycast box(draw::TestCanvas::device(), settings, {}, dust.ledger);
    TrailPicture picture(box, settings, {0, 1, 0}, true);
    picture.show(dust.trail, dust.box());
    double shown = std::accumulate(picture.faded().begin(), picture.faded().end(), 0.0);
    EXPECT_LT(shown, 0.8 * static_cast<double>(dust.density.size()));
    for (const auto& [place, values] : picture.lent()) shown = std::accumulate(values.begin(), values.end(), shown);
    EXPECT_NEAR(shown, static_cast<double>(dust.density.size()), 1e-3 * shown);
}

}  // namespace
}  // namespace dustbench::grid_fluid
