// Pressure and projection, checked with the equations that they solve.
#include <gtest/gtest.h>
#include <oneapi/tbb/task_arena.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "methods/grid_fluid/flow/fluid_solver.h"
#include "methods/grid_fluid/flow/kernels_test_world.h"
#include "methods/grid_fluid/flow/plain_pressure.h"
#include "methods/grid_fluid/flow/plain_projection.h"
#include "methods/grid_fluid/flow/pressure_solver.h"
#include "methods/grid_fluid/flow/projection.h"

namespace dustbench::grid_fluid::flow {
namespace {

/// Returns a field of the finest grid in the order of padded cells.
std::vector<double> padded(const CellLayout& layout, const PoissonLevel& level, const SplitField& field) {
    std::vector<double> values(layout.padded(), 0.0);
    for (int k = 0; k < layout.nz; ++k)
        for (int j = 0; j < layout.ny; ++j)
            for (int i = 0; i < layout.nx; ++i)
                values[layout.at(i, j, k)] = static_cast<double>(field.cell(level.layout, i, j, k));
    return values;
}

PlainPressure plainOf(const World& world, const PoissonLevel& level) {
    return {world.layout, world.solids.conductance(), padded(world.layout, level, level.rightSide)};
}

/// Returns the maximum of |∇·u| over the faces after the projection.
float divergenceAfter(const World& world, const PoissonLevel& level) {
    const std::uint8_t* conductance = world.solids.conductance();
    PlainPressure plain(world.layout, conductance, plainDivergence(world.from, world.layout, conductance));
    plain.q = padded(world.layout, level, level.pressure);
    return static_cast<float>(plain.maximumResidual());
}

struct Solved {
    PressureResult result;
    float divergence;
};

Solved solve(World& world, const PressureRule& rule) {
    setSideFaces(world.from, world.layout, world.ghostRule());
    PressureSolver solver(world.layout, world.sides);
    std::vector<float> memory(solver.floatsNeeded(), std::numeric_limits<float>::quiet_NaN());
    solver.build(memory, world.solids.conductance());
    gatherDivergence(world.from, world.layout, world.solids.conductance(), solver.finest());
    const PressureResult result = solver.solve(rule);
    return {result, divergenceAfter(world, solver.finest())};
}

TEST(Pressure, MakesTheFacesFreeOfDivergence) {
    const PressureRule rule{PressureMethod::multigrid, 0, 30, 1e-4f};
    for (const glm::ivec3 cells : {glm::ivec3(32, 16, 24), glm::ivec3(21, 13, 9), glm::ivec3(5, 37, 4)})
        for (const Sides& sides : {openOverFloor, withWind(openOverFloor, {0.3f, 0, 0})})
            for (const double share : {0.0, 0.05, 0.3}) {
                World world(cells, sides);
                world.fillRandom(1);
                world.setRandomSolids(share);
                const Solved solved = solve(world, rule);
                EXPECT_LE(solved.result.residual, 1e-4f) << cells.x << " share " << share;
                EXPECT_LE(solved.divergence, 1.5e-4f + solved.result.unremovable) << cells.x << " share " << share;
                EXPECT_LE(solved.result.cycles, share < 0.1 ? 6 : 15) << cells.x << " share " << share;
            }
}

TEST(Pressure, IsThatOfThePlainSweeps) {
    for (const Sides& sides : {openOverFloor, withWind(openOverFloor, {0.3f, 0, 0}), closed})
        for (const double share : {0.0, 0.1, 0.4}) {
            World world({13, 9, 7}, sides);
            world.fillRandom(1);
            world.setRandomSolids(share);
            const std::uint8_t* conductance = world.solids.conductance();
            PressureSolver solver(world.layout, world.sides);
            std::vector<float> memory(solver.floatsNeeded(), std::numeric_limits<float>::quiet_NaN());
            solver.build(memory, conductance);
            gatherDivergence(world.from, world.layout, conductance, solver.finest());
            const PressureResult result = solver.solve({PressureMethod::multigrid, 0, 40, 1e-5f});
            EXPECT_LE(result.residual, 1e-5f);
            // Use the balanced right-hand side. Without outflow the pressure is defined up to a constant, so compare
            // differences.
            PlainPressure plain = plainOf(world, solver.finest());
            for (int sweep = 0; sweep < 3000; ++sweep) plain.sweepGaussSeidel();
            ASSERT_LE(plain.maximumResidual(), 2e-6) << "share " << share;
            const std::vector<double> q = padded(world.layout, solver.finest(), solver.finest().pressure);
            for (std::size_t at = 0; at < q.size(); ++at) {
                if (conductance[at] != 1) continue;
                for (const std::size_t step : {std::size_t{1}, world.layout.row, world.layout.slab})
                    for (const std::size_t n : {at - step, at + step})
                        ASSERT_NEAR(conductance[n] * (q[n] - q[at]), conductance[n] * (plain.q[n] - plain.q[at]), 1e-4)
                            << at << " share " << share;
            }
        }
}

TEST(Pressure, JacobiSweepsAreThePlainOnes) {
    World world({21, 8, 5});
    world.fillRandom(1);
    world.setRandomSolids(0.1);
    PressureSolver solver(world.layout, world.sides);
    std::vector<float> memory(solver.floatsNeeded(), std::numeric_limits<float>::quiet_NaN());
    solver.build(memory, world.solids.conductance());
    gatherDivergence(world.from, world.layout, world.solids.conductance(), solver.finest());
    const PressureResult result = solver.solve({PressureMethod::jacobi, 7, 0, 0});
    PlainPressure plain = plainOf(world, solver.finest());
    for (int sweep = 0; sweep < 7; ++sweep) plain.sweepJacobi();
    const std::vector<double> q = padded(world.layout, solver.finest(), solver.finest().pressure);
    for (std::size_t at = 0; at < q.size(); ++at) ASSERT_NEAR(q[at], plain.q[at], 1e-5);
    EXPECT_NEAR(result.residual, plain.maximumResidual(), 1e-5);
}

TEST(Pressure, AllSweepsOfAPassAreThoseOneAfterTheOther) {
    for (const glm::ivec3 cells : {glm::ivec3(33, 21, 64), glm::ivec3(64, 9, 33), glm::ivec3(20, 5, 4)})
        for (const int threads : {1, 2, 4}) {
            World world(cells, openOverFloor);
            world.fillRandom(1);
            world.setRandomSolids(0.1);
            PressureSolver solver(world.layout, world.sides);
            std::vector<float> memory(solver.floatsNeeded(), std::numeric_limits<float>::quiet_NaN());
            solver.build(memory, world.solids.conductance());
            PoissonLevel& level = solver.finest();
            gatherDivergence(world.from, world.layout, world.solids.conductance(), level);
            std::vector<float> coarseMemory(1 << 20);
            Arena arena(coarseMemory);
            PoissonLevel coarse((cells + 1) / 2, false, arena);
            constexpr std::array relaxations{1.6f, 1.2f, 1.0f};
            float residual = 0;
            tbb::task_arena(threads).execute([&] {
                residual = level.smooth({.fromZero = true, .relaxations = relaxations, .restriction = &coarse});
            });
            PlainPressure plain = plainOf(world, level);
            for (const float relaxation : relaxations) plain.sweepGaussSeidel(static_cast<double>(relaxation));
            for (int k = 0; k < cells.z; ++k)
                for (int j = 0; j < cells.y; ++j)
                    for (int i = 0; i < cells.x; ++i)
                        ASSERT_NEAR(level.pressure.cell(level.layout, i, j, k), plain.q[world.layout.at(i, j, k)],
                                    1e-5);
            EXPECT_NEAR(residual, level.residual(), 1e-5);
            // Each residual belongs to exactly one coarse cell.
            for (int k = 0; k < cells.z; k += 2)
                for (int j = 0; j < cells.y; j += 2)
                    for (int i = 0; i < cells.x; i += 2) {
                        double sum = 0;
                        for (int z = k; z < std::min(k + 2, cells.z); ++z)
                            for (int y = j; y < std::min(j + 2, cells.y); ++y)
                                for (int x = i; x < std::min(i + 2, cells.x); ++x)
                                    sum += plain.residual(world.layout.at(x, y, z));
                        ASSERT_NEAR(coarse.rightSide.cell(coarse.layout, i / 2, j / 2, k / 2), sum, 1e-4);
                    }
        }
}

TEST(Projection, EqualsThePlainOne) {
    for (const glm::ivec3 cells : {glm::ivec3(53, 7, 5), glm::ivec3(64, 5, 6), glm::ivec3(4, 9, 17)})
        for (const Sides& sides : {openOverFloor, withWind(openOverFloor, {0.3f, 0, 0}), closed})
            for (const double share : {0.0, 0.02, 0.3}) {
                SCOPED_TRACE(std::to_string(cells.x) + " cells along x, share " + std::to_string(share));
                World world(cells, sides);
                world.fillRandom(1);
                world.setRandomSolids(share);
                const std::uint8_t* conductance = world.solids.conductance();
                PressureSolver solver(world.layout, world.sides);
                std::vector<float> memory(solver.floatsNeeded());
                solver.build(memory, conductance);
                PoissonLevel& level = solver.finest();
                gatherDivergence(world.from, world.layout, conductance, level);
                const std::vector<double> divergence = padded(world.layout, level, level.rightSide);
                const std::vector<double> plainly = plainDivergence(world.from, world.layout, conductance);
                for (std::size_t at = 0; at < divergence.size(); ++at)
                    ASSERT_NEAR(divergence[at], plainly[at], 2e-6) << at;

                std::uniform_real_distribution<float> value(-1, 1);
                level.clearPressure();
                for (int k = 0; k < cells.z; ++k)
                    for (int j = 0; j < cells.y; ++j)
                        for (int i = 0; i < cells.x; ++i)
                            level.pressure.cell(level.layout, i, j, k) = value(world.random);
                const CellField before = world.from;
                const std::vector<glm::dvec3> plain =
                    plainProjection(before, world.layout, conductance, padded(world.layout, level, level.pressure));
                subtractGradient(world.from, world.layout, conductance, level);
                for (std::size_t at = 0; at < plain.size(); ++at)
                    for (std::size_t lane = 0; lane < lanes; ++lane) {
                        const float now = world.from.cell(at)[lane];
                        if (lane < 3)
                            ASSERT_NEAR(now, plain[at][static_cast<int>(lane)], 2e-6) << at << " axis " << lane;
                        else
                            ASSERT_EQ(now, before.cell(at)[lane]) << at << " lane " << lane;
                    }
            }
}

TEST(Projection, LeavesNothingOfTheModeThatAlternatesFromFaceToFace) {
    // u_i = (−1)^i along its own axis: the means of two faces are 0 everywhere, so it would be invisible at the
    // centres.
    for (int axis = 0; axis < 3; ++axis) {
        World world({32, 32, 32}, closed);
        for (int k = 0; k < 32; ++k)
            for (int j = 0; j < 32; ++j)
                for (int i = 0; i < 32; ++i) {
                    const int along = std::array{i, j, k}[static_cast<std::size_t>(axis)];
                    if (along > 0) world.from.cell(world.layout.at(i, j, k))[axis] = along % 2 == 0 ? 1.0f : -1.0f;
                }
        PressureSolver solver(world.layout, world.sides);
        std::vector<float> memory(solver.floatsNeeded());
        solver.build(memory, world.solids.conductance());
        gatherDivergence(world.from, world.layout, world.solids.conductance(), solver.finest());
        solver.solve({PressureMethod::multigrid, 0, 30, 1e-4f});
        subtractGradient(world.from, world.layout, world.solids.conductance(), solver.finest());
        float maximum = 0;
        for (int k = 0; k < 32; ++k)
            for (int j = 0; j < 32; ++j)
                for (int i = 0; i < 32; ++i)
                    maximum = std::max(maximum, std::fabs(world.from.cell(world.layout.at(i, j, k))[axis]));
        EXPECT_LT(maximum, 1e-3f) << "axis " << axis;
        EXPECT_LT(maximumDivergence(world.from, world.layout, world.solids.conductance()), 2e-4f);
    }
}

TEST(Pressure, ConvergesBehindThinWallsAndInClosedBoxes) {
    World maze({32, 32, 32});
    maze.fillRandom(1);
    maze.inside.assign(32 * 32 * 32, 0);
    for (int k = 0; k < 32; ++k)
        for (int j = 0; j < 32; ++j)
            for (int i = 0; i < 32; ++i)
                if (i % 5 == 2 && (j + i) % 32 > 2) maze.inside[static_cast<std::size_t>((k * 32 + j) * 32 + i)] = 1;
    maze.solids.set({maze.inside, {}}, maze.from);
    const Solved behind = solve(maze, {PressureMethod::multigrid, 0, 40, 1e-4f});
    EXPECT_LE(behind.divergence, 1.5e-4f) << behind.result.cycles;

    World box({16, 16, 16}, closed);
    box.fillRandom(1);
    const Solved inBox = solve(box, {PressureMethod::multigrid, 0, 20, 1e-4f});
    EXPECT_LE(inBox.divergence, 1.5e-4f) << inBox.result.cycles;
    EXPECT_LE(inBox.result.unremovable, 1e-6f);
}

TEST(Pressure, SaysWhatNoPressureCanBalance) {
    // A wall of the box moves inwards and the fluid cannot leave.
    World world({8, 8, 8}, closed);
    world.inside.assign(512, 0);
    world.motions = {{{1, 0, 0}}};
    for (std::size_t row = 0; row < 64; ++row) world.inside[row * 8] = 1;
    world.solids.set({world.inside, world.motions}, world.from);
    const Solved solved = solve(world, {PressureMethod::multigrid, 0, 20, 1e-4f});
    EXPECT_NEAR(solved.result.unremovable, 1.0 / 7, 1e-5);
    EXPECT_NEAR(solved.divergence, 1.0 / 7, 1e-3);
}

TEST(Pressure, JacobiConvergesToTheSame) {
    World world({8, 8, 8});
    world.fillRandom(1);
    const Solved few = solve(world, {PressureMethod::jacobi, 20, 0, 0});
    const Solved many = solve(world, {PressureMethod::jacobi, 600, 0, 0});
    EXPECT_NEAR(few.divergence, few.result.residual, 1e-5);
    EXPECT_LT(many.divergence, 1e-4f);
    EXPECT_GT(few.divergence, 10 * many.divergence);
}

TEST(Pressure, KeepsWhatLiesElsewhereWithTheSameSolidsOnly) {
    // Without solids, then twice with a wall that compresses enclosed fluid: each time the result is that of a new
    // solver.
    World world({16, 8, 8}, closed);
    world.fillRandom(1);
    world.inside.assign(1024, 0);
    world.motions = {{{1, 0, 0}}};
    PressureSolver solver(world.layout, world.sides);
    const auto solvedAgain = [&](PressureSolver& by, bool sameSolids) {
        std::vector<float> memory(by.floatsNeeded(), std::numeric_limits<float>::quiet_NaN());
        by.build(memory, world.solids.conductance(), sameSolids);
        gatherDivergence(world.from, world.layout, world.solids.conductance(), by.finest());
        const PressureResult result = by.solve({PressureMethod::multigrid, 0, 30, 1e-4f});
        return std::pair(result.unremovable, padded(world.layout, by.finest(), by.finest().pressure));
    };
    for (const bool wall : {false, true, true}) {
        const bool sameSolids = wall && world.inside[0] == 1;
        if (wall)
            for (std::size_t row = 0; row < 64; ++row) world.inside[row * 16] = 1;
        world.solids.set({world.inside, world.motions}, world.from);
        PressureSolver another(world.layout, world.sides);
        const auto here = solvedAgain(solver, sameSolids), there = solvedAgain(another, false);
        EXPECT_EQ(here, there);
        EXPECT_EQ(here.first > 0.01f, wall);
    }
}

TEST(Pressure, OfAFluidKnowsWhenItsSolidsChange) {
    FluidSettings settings;
    settings.box = {{8, 8, 8}, 1, {}};
    settings.sides = closed;
    MemoryLedger ledger;
    FluidSolver fluid(settings, ledger);
    EXPECT_LE(fluid.step(1, {}).pressure.unremovable, 1e-6f);
    std::vector<std::uint8_t> inside(512, 0);
    for (std::size_t row = 0; row < 64; ++row) inside[row * 8] = 1;
    const std::vector<BodyMotion> motions{{{0.5f, 0, 0}}};
    fluid.setSolids({inside, motions});
    EXPECT_NEAR(fluid.step(1, {}).pressure.unremovable, 0.5 / 7, 1e-5);
    EXPECT_NEAR(fluid.step(1, {}).pressure.unremovable, 0.5 / 7, 1e-5);
    fluid.setSolids({});
    EXPECT_LE(fluid.step(1, {}).pressure.unremovable, 1e-6f);
}

TEST(ClosedRegions, AreFoundWhereNothingFlowsOut) {
    World world({9, 9, 9});
    world.inside.assign(729, 0);
    for (int k = 2; k < 7; ++k)
        for (int j = 2; j < 7; ++j)
            for (int i = 2; i < 7; ++i) world.inside[static_cast<std::size_t>((k * 9 + j) * 9 + i)] = 1;
    for (int i = 3; i < 6; ++i) world.inside[static_cast<std::size_t>((4 * 9 + 4) * 9 + i)] = 0;
    world.solids.set({world.inside, {}}, world.from);
    const auto regions = closedRegions(world.layout, world.solids.conductance());
    ASSERT_EQ(regions.size(), 1u);
    ASSERT_EQ(regions[0].size(), 1u);
    EXPECT_EQ(regions[0][0].i, 3);
    EXPECT_EQ(regions[0][0].end, 6);
}

}  // namespace
}  // namespace dustbench::grid_fluid::flow
