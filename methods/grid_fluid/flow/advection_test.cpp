// Tests advection of a scalar in a prescribed flow: order of convergence, and effect on a peak.
#include "methods/grid_fluid/flow/advection.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "methods/grid_fluid/flow/box_ghosts.h"
#include "methods/grid_fluid/flow/solid_cells.h"
#include "methods/grid_fluid/flow/solver.h"

namespace dustbench::grid_fluid::flow {
namespace {

using std::numbers::pi;

template <typename Cell>
void forAllCells(const CellLayout& layout, const Cell& cell) {
    for (int k = 0; k < layout.nz; ++k)
        for (int j = 0; j < layout.ny; ++j)
            for (int i = 0; i < layout.nx; ++i) cell(i, j, k, layout.at(i, j, k));
}

struct Carried {
    double error;  ///< root mean square
    double peak;
};

/// Rotates a Gaussian of σ = 0.09 by `turns` turns around the centre of a unit square of n×n cells. It moves by 0.6
/// cells per step.
Carried carryRound(int n, AdvectionRule rule, double turns) {
    const CellLayout layout(glm::ivec3(n, n, 1));
    MemoryLedger ledger;
    CellField from(layout, ledger.account("a")), to(layout, ledger.account("b"));
    SolidCells solids(layout, openOverFloor, ledger.account("c"));
    (void)solids.set({}, from);
    Advection advection(layout, ledger.account("d"));
    const int steps = static_cast<int>(std::lround(turns * 2 * pi * 0.22 * n / 0.6));
    const double angle = turns * 2 * pi / steps;
    const auto gaussian = [&](int i, int j, double at) {
        const double x = (i + 0.5) / n - 0.5 - 0.22 * std::cos(at), y = (j + 0.5) / n - 0.5 - 0.22 * std::sin(at);
        return std::exp(-(x * x + y * y) / (2 * 0.09 * 0.09));
    };
    // The flow, in cells per step; restored at each step, since the velocity is advected as well.
    const auto setFlow = [&](CellField& field) {
        for (int k = -1; k <= 1; ++k)
            for (int j = -1; j <= n; ++j)
                for (int i = -1; i <= n; ++i) {
                    float* record = field.cell(layout.at(i, j, k));
                    record[velocityX] = static_cast<float>(-angle * (j + 0.5 - n * 0.5));  // the same on its faces
                    record[velocityY] = static_cast<float>(angle * (i + 0.5 - n * 0.5));
                    record[velocityZ] = 0;
                }
    };
    forAllCells(layout, [&](int i, int j, int, std::size_t at) {
        from.cell(at)[density] = static_cast<float>(gaussian(i, j, 0));
    });
    for (int step = 0; step < steps; ++step) {
        fillGhosts(from, layout, {closed, {}, false});
        setFlow(from);
        advection.advect(from, to, solids.moving(), rule, {.cellsPerSpeed = 1});
    }
    Carried carried{0, 0};
    forAllCells(layout, [&](int i, int j, int, std::size_t at) {
        const double value = static_cast<double>(from.cell(at)[density]);
        carried.error += std::pow(value - gaussian(i, j, turns * 2 * pi), 2);
        carried.peak = std::max(carried.peak, value);
    });
    carried.error = std::sqrt(carried.error / n / n);
    return carried;
}

TEST(Advection, ConvergesAtItsOrder) {
    const auto orders = [](AdvectionRule rule) {
        const double coarse = carryRound(32, rule, 0.25).error, middle = carryRound(64, rule, 0.25).error,
                     fine = carryRound(128, rule, 0.25).error;
        return glm::dvec2(std::log2(coarse / middle), std::log2(middle / fine));
    };
    const glm::dvec2 first = orders({AdvectionScheme::semiLagrangian});
    const glm::dvec2 second = orders({AdvectionScheme::macCormack, Limit::none});
    EXPECT_NEAR(first.y, 1, 0.15) << first.x;
    EXPECT_NEAR(second.y, 2, 0.2) << second.x;
    EXPECT_GT(first.x, 0.6);
    EXPECT_GT(second.x, 1.6);
}

/// The error, in radians, of a rotation whose speed doubles meanwhile. It carries φ = x, which interpolation preserves;
/// the effect of the sides does not reach the middle.
double offAfterFasterAndFasterTurns(int steps, AdvectionRule rule) {
    constexpr int n = 128;
    constexpr double turned = 1;
    const CellLayout layout(glm::ivec3(n, n, 1));
    MemoryLedger ledger;
    CellField cells(layout, ledger.account("a")), spare(layout, ledger.account("b"));
    SolidCells solids(layout, openOverFloor, ledger.account("c"));
    (void)solids.set({}, cells);
    Advection advection(layout, ledger.account("d"));
    const auto place = [](int i) { return static_cast<float>(i) + 0.5f - 0.5f * n; };
    forAllCells(layout, [&](int i, int, int, std::size_t at) { cells.cell(at)[density] = place(i); });
    const double begin = turned / 1.5 / steps;  // radians per step
    for (int step = 0; step < steps; ++step) {
        const auto angle = static_cast<float>(begin * (1 + static_cast<double>(step) / steps));
        fillGhosts(cells, layout, {closed, {}, false});
        for (int k = -1; k <= 1; ++k)
            for (int j = -1; j <= n; ++j)
                for (int i = -1; i <= n; ++i) {
                    float* record = cells.cell(layout.at(i, j, k));
                    record[velocityX] = -angle * place(j);  // the same on its faces
                    record[velocityY] = angle * place(i);
                    record[velocityZ] = 0;
                }
        const glm::vec3 fastest(angle * n, angle * n, 0);
        advection.advect(cells, spare, solids.moving(), rule, {1, fastest, step == 0 ? 0.0f : 0.5f});
    }
    const auto at = [&](int i, int j) {
        return static_cast<double>(cells.cell(layout.at(n / 2 + i, n / 2 + j, 0))[density]);
    };
    return std::atan2(at(0, 4) - at(0, -4), at(4, 0) - at(-4, 0)) - turned;
}

TEST(Advection, PathsThroughAFlowThatChangesAreOfSecondOrderByTheVelocityOfTheMiddle) {
    for (const auto scheme : {AdvectionScheme::semiLagrangian, AdvectionScheme::macCormack}) {
        const auto off = [&](int steps, VelocityAt time) {
            return std::fabs(offAfterFasterAndFasterTurns(steps, {scheme, Limit::none, time}));
        };
        const double begin = off(24, VelocityAt::begin), middle = off(24, VelocityAt::middle);
        EXPECT_NEAR(std::log2(off(12, VelocityAt::begin) / begin), 1, 0.1);
        EXPECT_NEAR(std::log2(off(12, VelocityAt::middle) / middle), 2, 0.1);
        EXPECT_LT(middle, 0.05 * begin);
    }
}

/// The state after three steps through a wave along z that ends at the box's sides, as a hash, and the memory held.
std::pair<std::uint64_t, std::size_t> advectedThroughWaves(AdvectionRule rule, float speed, float fastestAlongZ) {
    constexpr glm::ivec3 box(9, 6, 90);
    const CellLayout layout(box);
    MemoryLedger ledger;
    CellField cells(layout, ledger.account("a")), spare(layout, ledger.account("b"));
    SolidCells solids(layout, openOverFloor, ledger.account("c"));
    (void)solids.set({}, cells);
    forAllCells(layout, [&](int i, int j, int k, std::size_t at) {
        cells.cell(at)[density] = static_cast<float>((7 * i + 5 * j + 3 * k) % 11);
    });
    MemoryAccount& held = ledger.account("advection");
    Advection advection(layout, held);
    for (int step = 0; step < 3; ++step) {
        fillGhosts(cells, layout, {closed, {}, false});
        for (glm::ivec3 c(-1); c.z <= box.z; ++c.z)
            for (c.y = -1; c.y <= box.y; ++c.y)
                for (c.x = -1; c.x <= box.x; ++c.x) {
                    float* record = cells.cell(layout.at(c.x, c.y, c.z));
                    record[velocityX] = record[velocityY] = 0.3f;
                    record[velocityZ] = speed * static_cast<float>(std::sin(2 * pi * (c.z + 0.5) / box.z) *
                                                                   std::cos(0.1 * c.x + 0.2 * step));
                }
        const float ahead = step == 0 ? 0.0f : 0.5f;
        advection.advect(cells, spare, solids.moving(), rule, {1, {0.3f, 0.3f, fastestAlongZ}, ahead});
    }
    return {hashOf(cells, layout), held.bytes()};
}

TEST(Advection, IsTheSameHoweverFewSlabsAreHeld) {
    // If the flow is declared to be fast along z, all slabs are stored.
    for (const float speed : {0.4f, 1.3f, 3.5f})
        for (const auto scheme : {AdvectionScheme::semiLagrangian, AdvectionScheme::macCormack})
            for (const Limit limit : {Limit::clamp, Limit::revert})
                for (const auto time : {VelocityAt::begin, VelocityAt::middle}) {
                    const AdvectionRule rule{scheme, limit, time};
                    const auto few = advectedThroughWaves(rule, speed, 1.1f * speed);
                    const auto all = advectedThroughWaves(rule, speed, 90);
                    EXPECT_EQ(few.first, all.first) << speed;
                    EXPECT_LT(few.second, all.second) << speed;
                }
}

TEST(Advection, WhatAlternatesFromCellToCellDoesNotStayBehind) {
    // Half a cell per step along an axis: interpolation removes φ = (−1)^i, and an unfiltered correction restores half.
    constexpr int n = 12;
    for (int axis = 0; axis < 3; ++axis)
        for (const Limit limit : {Limit::clamp, Limit::revert, Limit::none}) {
            const CellLayout layout({n, n, n});
            MemoryLedger ledger;
            CellField cells(layout, ledger.account("a")), spare(layout, ledger.account("b"));
            SolidCells solids(layout, openOverFloor, ledger.account("c"));
            (void)solids.set({}, cells);
            for (int k = -1; k <= n; ++k)
                for (int j = -1; j <= n; ++j)
                    for (int i = -1; i <= n; ++i) {
                        float* record = cells.cell(layout.at(i, j, k));
                        record[axis] = 0.5f;
                        record[density] = glm::ivec3(i, j, k)[axis] % 2 == 0 ? 1.0f : -1.0f;
                    }
            Advection advection(layout, ledger.account("d"));
            advection.advect(cells, spare, solids.moving(), {AdvectionScheme::macCormack, limit}, {1, glm::vec3(0.5f)});
            forAllCells(layout, [&](int i, int j, int k, std::size_t at) {
                const int along = glm::ivec3(i, j, k)[axis];
                if (along > 1 && along < n - 2) {
                    EXPECT_NEAR(cells.cell(at)[density], 0, 1e-6) << axis << along;
                }
            });
        }
}

TEST(Advection, ATurnCostsThePeakWhatIsKnownOfEachScheme) {
    // Linear interpolation at a fraction f of a cell adds f(1 − f) cells² to σ² along that axis. On a circle at 0.6
    // cells per step the mean is 0.6·2/π − 0.36/2; the peak decreases as σ² grows.
    const double before = std::pow(0.09 * 64, 2), steps = 2 * pi * 0.22 * 64 / 0.6;
    const double known = before / (before + steps * (0.6 * 2 / pi - 0.18));
    EXPECT_NEAR(carryRound(64, {AdvectionScheme::semiLagrangian}, 1).peak, known, 0.02);
    // A second-order scheme preserves the peak, except for the part that the clamp cuts off.
    EXPECT_NEAR(carryRound(64, {AdvectionScheme::macCormack, Limit::clamp}, 1).peak, 1, 0.05);
    EXPECT_NEAR(carryRound(64, {AdvectionScheme::macCormack, Limit::none}, 1).peak, 1, 0.04);
}

}  // namespace
}  // namespace dustbench::grid_fluid::flow
