// Tests light through a cloud of several grids, and that the border between a fluid's box and its trail is invisible.
#include "methods/grid_fluid/trail_picture.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "methods/kit/draw/test_canvas.h"
#include "methods/kit/raycast/light_volume.h"

namespace dustbench::grid_fluid {
namespace {

constexpr CloudShade::Id left{0, 0, 0}, right{1, 0, 0};

/// Evenly filled; two such grids are adjacent along x.
struct Even {
    [[nodiscard]] raycast::ShownGrid at(double x) const { return {{16, 16, 16}, 0.25, {x, 0, 0}, density, {}}; }
    std::vector<float> density = std::vector<float>(static_cast<std::size_t>(16 * 16 * 16), 0.5f);
};

TEST(CloudShade, IsBeersLawThroughAllGridsButOne) {
    const Even even;
    CloudShade shade({1, 0, 0}, 0.8);
    shade.set(left, even.at(0));
    shade.set(right, even.at(4));
    EXPECT_NEAR(shade.arrivingAt({1, 2, 2}, left), std::exp(-0.8 * 0.5 * 4), 1e-5);
    EXPECT_NEAR(shade.arrivingAt({1, 2, 2}, right), std::exp(-0.8 * 0.5 * 3), 1e-5);
    EXPECT_EQ(shade.arrivingAt({9, 2, 2}, left), 1);
    EXPECT_EQ(shade.arrivingAt({1, 9, 2}, left), 1);
    shade.change(right, {5, 0, 0}, 0.25);
    EXPECT_NEAR(shade.arrivingAt({6, 2, 2}, left), std::exp(-0.8 * 0.125 * 3), 1e-5);
    shade.remove(right);
    EXPECT_EQ(shade.arrivingAt({1, 2, 2}, left), 1);
}

TEST(CloudShade, LightsTwoGridsAsOne) {
    const Even even;
    raycast::RaycastSettings settings;
    settings.shadowCells = 2;
    settings.extinctionPerMetre = 0.8;
    const glm::vec3 toSun = glm::normalize(glm::vec3(1, 0.1f, 0));
    CloudShade shade(toSun, settings.extinctionPerMetre);
    shade.set(left, even.at(0));
    shade.set(right, even.at(4));
    MemoryLedger ledger;
    const auto ofRow = [&](const raycast::ShownGrid& grid, const CloudShade::Id& id) {
        raycast::LightVolume light(settings, toSun, ledger);
        light.set(grid, [&](const glm::dvec3& place) { return shade.arrivingAt(place, id); });
        const std::size_t first = 8 * (1 + 8 * 4);  // near the floor, so that all rays leave by the far end
        return std::vector<float>(light.values().begin() + first, light.values().begin() + first + 8);
    };
    std::vector<float> both = ofRow(even.at(0), left);
    const std::vector<float> second = ofRow(even.at(4), right);
    both.insert(both.end(), second.begin(), second.end());
    for (std::size_t n = 0; n < both.size(); ++n) {
        const double way = (8 - 0.5 * (static_cast<double>(n) + 0.5)) / static_cast<double>(toSun.x);
        EXPECT_NEAR(static_cast<double>(both[n]) / std::exp(-0.8 * 0.5 * way), 1, 0.03) << n;
    }
}

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
