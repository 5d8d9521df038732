// Tests light through a cloud of several grids.
#include "methods/grid_fluid/cloud_shade.h"

#include <gtest/gtest.h>

#include <cmath>

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

}  // namespace
}  // namespace dustbench::grid_fluid
