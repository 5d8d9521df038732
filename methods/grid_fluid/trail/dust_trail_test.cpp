// Tests the trail of dust alone, and together with a box with which it exchanges dust.
#include "methods/grid_fluid/trail/dust_trail.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "methods/grid_fluid/flow/fluid_solver.h"
#include "methods/grid_fluid/trail/fluid_trail.h"

namespace dustbench::grid_fluid {
namespace {

constexpr double h = 0.2;

/// Amount and moment of all cells.
glm::dvec4 momentOf(const DustTrail& trail) {
    glm::dvec4 sum(0);
    for (const auto& [place, tile] : trail.tiles())
        for (std::size_t n = 0; n < tile.density.size(); ++n) {
            const std::size_t edge = DustTrail::edge;
            const glm::dvec3 middle =
                trail.originOf(place) + h * (glm::dvec3(n % edge, n / edge % edge, n / edge / edge) + 0.5);
            const double amount = static_cast<double>(tile.density[n]) * tile.share * h * h * h;
            sum += amount * glm::dvec4(middle, 1);
        }
    return sum;
}

TEST(Overlaps, ShareOutAStretchByLength) {
    std::mt19937 random(3);
    std::uniform_real_distribution<double> place(-9, 9), length(0, 1);
    for (int n = 0; n < 1000; ++n) {
        const double from = n % 3 == 0 ? std::round(place(random)) : place(random);
        const double to = from + (n % 2 == 0 ? 1 : length(random));
        const Overlaps overlaps(from, to);
        EXPECT_NEAR(overlaps.shares[0] + overlaps.shares[1], 1, 1e-12);
        const double within = std::min(to, overlaps.first + 1.0) - std::max(from, static_cast<double>(overlaps.first));
        if (to - from > 0.01) {
            EXPECT_NEAR(overlaps.shares[0], within / (to - from), 2e-6);
        }
        EXPECT_EQ(overlaps.count, overlaps.shares[1] > 0 ? 2 : 1);
        if (n % 6 == 0) {
            EXPECT_EQ(overlaps.count, 1) << "a cell of the same lattice overlaps one cell";
        }
    }
}

TEST(DustTrail, GoesWithTheWindAgesAndLosesNothing) {
    MemoryLedger ledger;
    DustTrail trail({h, {1.3f, 0, -0.7f}, 0.25f}, ledger.account("trail"));
    std::mt19937 random(5);
    std::uniform_real_distribution<double> place(-8, 8), share(0.01, 1);
    glm::dvec4 expected(0);
    const float seconds = 1.0f / 60;
    const glm::dvec3 moved = glm::dvec3(1.3f, 0, -0.7f) * static_cast<double>(seconds);
    const auto kept = static_cast<double>(std::exp(-0.25f * seconds));
    for (int step = 0; step < 100; ++step) {
        trail.pass(seconds);
        expected = kept * (expected + glm::dvec4(moved, 0) * expected.w);
        for (int n = 0; n < 20; ++n) {
            const glm::dvec3 corner(place(random), place(random), place(random));
            const glm::dvec3 extent = h * glm::dvec3(share(random), share(random), share(random));
            trail.add({corner, corner + extent}, 0.3);
            expected += 0.3 * glm::dvec4(corner + extent / 2.0, 1);
        }
    }
    trail.settle();
    const glm::dvec4 found = momentOf(trail);
    EXPECT_NEAR(found.w, expected.w, 1e-6 * expected.w);
    EXPECT_NEAR(trail.amountM3(), expected.w, 1e-6 * expected.w);
    // Cells of 0.2 m spread their dust, symmetrically only on average over 2000 cuboids.
    for (int axis = 0; axis < 3; ++axis) EXPECT_NEAR(found[axis] / found.w, expected[axis] / expected.w, 0.01);
}

TEST(DustTrail, KeepsEvenDustEvenThoughItsLatticeDrifts) {
    // A side lets through dust of density 1 at the wind's speed, cell by cell across it.
    MemoryLedger ledger;
    const float wind = 2.3f, seconds = 1.0f / 60;
    DustTrail trail({h, {wind, 0, 0}, 0}, ledger.account("trail"));
    const double reach = static_cast<double>(wind * seconds);
    for (int step = 0; step < 200; ++step) {
        trail.pass(seconds);
        for (int k = 0; k < 3; ++k)
            for (int j = 0; j < 3; ++j) trail.add({{0, h * j, h * k}, {reach, h * j + h, h * k + h}}, reach * h * h);
    }
    trail.settle();
    int even = 0;
    for (const auto& [place, tile] : trail.tiles())
        for (std::size_t n = 0; n < tile.density.size(); ++n) {
            const glm::dvec3 middle = trail.originOf(place) + h * (glm::dvec3(n % 32, n / 32 % 32, n / 1024) + 0.5);
            const bool inside = middle.x > h && middle.x < 200 * reach - h && middle.y > 0 && middle.y < 3 * h &&
                                middle.z > 0 && middle.z < 3 * h;
            if (!inside) continue;
            ++even;
            EXPECT_NEAR(tile.density[n], 1, 1e-4) << middle.x;
        }
    EXPECT_GT(even, 9 * 30);
}

TEST(DustTrail, GivesBackOnceWhatComesToLieInABox) {
    MemoryLedger ledger;
    DustTrail trail({h, {0, 0, 0}, 0}, ledger.account("trail"));
    const auto take = [&](double from) {
        double taken = 0;
        trail.takeEntered({{from, 0, 0}, {from + 10 * h, 10 * h, 10 * h}},
                          [&](const glm::dvec3& middle, double amount) {
                              EXPECT_GT(middle.x, from);
                              EXPECT_LT(middle.x, from + 10 * h);
                              taken += amount;
                          });
        return taken;
    };
    EXPECT_EQ(take(0), 0);
    for (int i = -20; i < 40; ++i) trail.add({{i * h, 0, 0}, {i * h + h, h, h}}, 1);
    EXPECT_EQ(take(0), 0) << "dust added within the box stays: the box has just released it";
    EXPECT_NEAR(take(4 * h), 4, 1e-5);
    EXPECT_EQ(take(4 * h), 0);
    EXPECT_NEAR(take(-3 * h), 3 + 4, 1e-5);  // behind it, and cells 0 to 3, which it passes again
    trail.settle();
    EXPECT_NEAR(trail.amountM3(), 60 - 11, 1e-4);
}

TEST(DustTrail, DropsATileOnlyIfItIsQuietSmallAndUnseen) {
    MemoryLedger ledger;
    DustTrail trail({h, {0, 0, 0}, 1}, ledger.account("trail"));
    const auto tilesLeft = [&](double leastM3, double leastDensity) {
        trail.settle(leastM3, leastDensity);
        return trail.tiles().size();
    };
    // Small amounts, each below the minimum of a tile.
    for (int step = 0; step < 300; ++step) {
        trail.add({{0, 0, 0}, {h, h, h}}, 0.001);
        trail.pass(0.01f);
        EXPECT_EQ(tilesLeft(0.5, 1e9), 1u);
    }
    EXPECT_NEAR(trail.amountM3(), 0.1 * (1 - std::exp(-3.0)), 2e-3);
    trail.pass(1.1f);
    const double density = trail.amountM3() / (h * h * h);
    EXPECT_EQ(tilesLeft(0.9 * trail.amountM3(), 1e9), 1u);
    EXPECT_EQ(tilesLeft(1, 0.9 * density), 1u);
    EXPECT_EQ(tilesLeft(1, 1.1 * density), 0u);
}

/// A box of random density that does not flow, and a trail.
struct Still {
    explicit Still(const glm::vec3& wind = glm::vec3(0)) {
        settings.box = {{24, 16, 20}, h, {0, 0, 0}};
        settings.windMetresPerSecond = wind;
        settings.notesLeaving = settings.keepsDensity = true;
        solver.emplace(settings, ledger);
        trail.emplace(settings, 1, ledger);
        std::mt19937 random(9);
        std::uniform_real_distribution<float> density(0, 1);
        for (int k = 0; k < 20; ++k)
            for (int j = 0; j < 16; ++j)
                for (int i = 0; i < 24; ++i)
                    solver->changeCells().cell(solver->layout().at(i, j, k))[flow::density] = density(random);
    }
    [[nodiscard]] std::vector<float> density() const {
        std::vector<float> values(settings.box.cellCount());
        solver->gather(flow::density, values);
        return values;
    }
    [[nodiscard]] double amountM3() const {
        double sum = 0;
        for (const float value : density()) sum += static_cast<double>(value);
        return sum * h * h * h + trail->dust().amountM3();
    }
    void move(const glm::ivec3& by) {
        trail->leave(solver->box(), by, density());
        solver->scroll(by);
        trail->enter(*solver);
    }

    MemoryLedger ledger;
    flow::FluidSettings settings;
    std::optional<flow::FluidSolver> solver;
    std::optional<FluidTrail> trail;
};

TEST(FluidTrail, IsLeftByAMovingBoxAndTakenUpAgainByTheCell) {
    Still still;
    const std::vector<float> before = still.density();
    const double amount = still.amountM3();
    for (const glm::ivec3 by : {glm::ivec3(5, 0, 0), {4, 0, -7}, {40, 30, 0}, {-40, -30, 7}, {-9, 0, 0}}) {
        still.move(by);
        still.trail->pass(*still.solver, 1e-3f, {});
        EXPECT_NEAR(still.amountM3(), amount, 1e-5 * amount);
    }
    const std::vector<float> after = still.density();
    for (std::size_t n = 0; n < before.size(); ++n) ASSERT_NEAR(after[n], before[n], 1e-6f) << n;
}

TEST(FluidTrail, GetsWhatTheFlowCarriesThroughTheSides) {
    for (const glm::vec3 wind : {glm::vec3(2, 0, 1), glm::vec3(-3, 0, 0.5f)}) {
        Still still(wind);
        const double amount = still.amountM3();
        for (int step = 0; step < 40; ++step) {
            still.trail->enter(*still.solver);
            still.solver->setSolids({});
            still.solver->step(1.0 / 60, {});
            still.trail->pass(*still.solver, 1.0f / 60, {});
            if (step % 10 == 3) still.move({2, 0, -1});
        }
        EXPECT_NEAR(still.amountM3(), amount, 1e-4 * amount);
        EXPECT_GT(still.trail->dust().amountM3(), 0.2 * amount);
    }
}

}  // namespace
}  // namespace dustbench::grid_fluid
