// The pressure and the projection against the equations that they solve.
#include <gtest/gtest.h>
#include <oneapi/tbb/task_arena.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <random>
#include <span>
#include <vector>

#include "methods/shared/fluid/kernels_test_world.h"
#include "methods/shared/fluid/pressure_solver.h"
#include "methods/shared/fluid/projection.h"

namespace dustbench::fluid {
namespace {

/// Greatest |∇·u| over the faces that the projection leaves, computed face by face.
float divergenceAfter(const World& world, const PressureSolver& solver) {
    const CellLayout& layout = world.layout;
    const std::uint8_t* conductance = world.solids.conductance();
    const PoissonLevel& level = solver.finest();
    const std::array<std::ptrdiff_t, 3> steps{1, static_cast<std::ptrdiff_t>(layout.row),
                                              static_cast<std::ptrdiff_t>(layout.slab)};
    float most = 0;
    for (int k = 0; k < layout.nz; ++k)
        for (int j = 0; j < layout.ny; ++j)
            for (int i = 0; i < layout.nx; ++i) {
                const std::size_t at = layout.at(i, j, k);
                if (conductance[at] != 1) continue;
                float sum = 0;
                for (int axis = 0; axis < 3; ++axis)
                    for (const int way : {-1, 1}) {
                        const std::ptrdiff_t step = way * steps[static_cast<std::size_t>(axis)];
                        glm::ivec3 other(i, j, k);
                        other[axis] += way;
                        const float weight = conductance[static_cast<std::ptrdiff_t>(at) + step];
                        const float own = level.pressure.cell(level.layout, i, j, k);
                        const float q = level.pressure.cell(level.layout, other.x, other.y, other.z);
                        const float speed =
                            faceSpeed(world.from, conductance, at, step, static_cast<std::size_t>(axis));
                        sum += static_cast<float>(way) * speed - weight * (q - own);
                    }
                most = std::max(most, std::fabs(sum));
            }
    return most;
}

struct Solved {
    PressureResult result;
    float divergence;
};

Solved solve(World& world, const PressureRule& rule) {
    fillGhosts(world.from, world.layout, {world.sides, {0.3f, 0, 0}, false}, GhostUse::faces);
    PressureSolver solver(world.layout, world.sides);
    std::vector<float> memory(solver.floatsNeeded(), std::numeric_limits<float>::quiet_NaN());
    solver.build(memory, world.solids.conductance());
    gatherDivergence(world.from, world.layout, world.solids.conductance(), solver.finest());
    const PressureResult result = solver.solve(rule);
    return {result, divergenceAfter(world, solver)};
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

/// Gauss-Seidel as it is written down: cell by cell, red and then black, from a pressure of zero.
std::vector<float> sweptPressure(const World& world, const PoissonLevel& level, std::span<const float> relaxations) {
    const CellLayout& layout = world.layout;
    const std::uint8_t* conductance = world.solids.conductance();
    std::vector<float> p(layout.padded(), 0.0f);
    for (const float relaxation : relaxations)
        for (int colour = 0; colour < 2; ++colour)
            for (int k = 0; k < layout.nz; ++k)
                for (int j = 0; j < layout.ny; ++j)
                    for (int i = (colour + j + k) % 2; i < layout.nx; i += 2) {
                        const std::size_t at = layout.at(i, j, k);
                        if (conductance[at] != 1) continue;
                        float sum = 0, weights = 0;
                        for (const std::size_t step : {std::size_t{1}, layout.row, layout.slab})
                            for (const std::size_t other : {at - step, at + step}) {
                                sum += static_cast<float>(conductance[other]) * p[other];
                                weights += conductance[other];
                            }
                        const float f = level.rightSide.cell(level.layout, i, j, k);
                        const float solved = weights > 0 ? (sum - f) / weights : 0.0f;
                        p[at] += (colour == 1 ? relaxation : 1) * (solved - p[at]);
                    }
    return p;
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
            const std::vector<float> swept = sweptPressure(world, level, relaxations);
            for (int k = 0; k < cells.z; ++k)
                for (int j = 0; j < cells.y; ++j)
                    for (int i = 0; i < cells.x; ++i)
                        ASSERT_NEAR(level.pressure.cell(level.layout, i, j, k), swept[world.layout.at(i, j, k)], 1e-5);
            EXPECT_NEAR(residual, level.residual(), 1e-5);
            // Each residual is in one coarse cell.
            const auto residualOf = [&](int i, int j, int k) {
                const std::size_t at = world.layout.at(i, j, k);
                if (world.solids.conductance()[at] != 1) return 0.0f;
                float r = level.rightSide.cell(level.layout, i, j, k);
                for (const std::size_t step : {std::size_t{1}, world.layout.row, world.layout.slab})
                    for (const std::size_t other : {at - step, at + step})
                        r -= static_cast<float>(world.solids.conductance()[other]) * (swept[other] - swept[at]);
                return r;
            };
            for (int k = 0; k < cells.z; k += 2)
                for (int j = 0; j < cells.y; j += 2)
                    for (int i = 0; i < cells.x; i += 2) {
                        float sum = 0;
                        for (int z = k; z < std::min(k + 2, cells.z); ++z)
                            for (int y = j; y < std::min(j + 2, cells.y); ++y)
                                for (int x = i; x < std::min(i + 2, cells.x); ++x) sum += residualOf(x, y, z);
                        ASSERT_NEAR(coarse.rightSide.cell(coarse.layout, i / 2, j / 2, k / 2), sum, 1e-4);
                    }
        }
}

TEST(Projection, TakesOffHalfTheDifferenceOfTheNeighboursPressures) {
    for (const double share : {0.0, 0.02}) {
        World world({53, 7, 5});
        world.fillRandom(1);
        world.setRandomSolids(share);
        PressureSolver solver(world.layout, world.sides);
        std::vector<float> memory(solver.floatsNeeded());
        solver.build(memory, world.solids.conductance());
        std::uniform_real_distribution<float> value(-1, 1);
        const SplitLayout& layout = solver.finest().layout;
        const auto q = [&](int i, int j, int k) -> float& { return solver.finest().pressure.cell(layout, i, j, k); };
        solver.finest().clearPressure();
        for (int k = 0; k < 5; ++k)
            for (int j = 0; j < 7; ++j)
                for (int i = 0; i < 53; ++i) q(i, j, k) = value(world.random);
        const CellField before = world.from;
        Projection().subtractGradient(world.from, world.layout, world.solids, solver.finest());
        const std::uint8_t* conducts = world.solids.conductance();
        int looked = 0;
        for (int k = 1; k < 4; ++k)
            for (int j = 1; j < 6; ++j)
                for (int i = 1; i < 52; ++i) {
                    const std::size_t at = world.layout.at(i, j, k), row = world.layout.row, slab = world.layout.slab;
                    if (conducts[at] * conducts[at - 1] * conducts[at + 1] * conducts[at - row] * conducts[at + row] *
                            conducts[at - slab] * conducts[at + slab] !=
                        1)
                        continue;
                    const glm::vec3 change(q(i + 1, j, k) - q(i - 1, j, k), q(i, j + 1, k) - q(i, j - 1, k),
                                           q(i, j, k + 1) - q(i, j, k - 1));
                    for (int axis = 0; axis < 3; ++axis)
                        EXPECT_NEAR(world.from.cell(at)[axis], before.cell(at)[axis] - 0.5f * change[axis], 1e-6);
                    for (std::size_t lane = 3; lane < lanes; ++lane)
                        EXPECT_EQ(world.from.cell(at)[lane], before.cell(at)[lane]);
                    ++looked;
                }
        EXPECT_GT(looked, 500);
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
    // A wall of the box moves inwards and nothing can leave.
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
}  // namespace dustbench::fluid
