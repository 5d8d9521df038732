// The kernels against slow, clear versions of themselves, and the pressure against the equations it solves.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>

#include "methods/shared/fluid/advection.h"
#include "methods/shared/fluid/box_ghosts.h"
#include "methods/shared/fluid/forces.h"
#include "methods/shared/fluid/pressure_solver.h"
#include "methods/shared/fluid/projection.h"
#include "methods/shared/fluid/solid_cells.h"

namespace dustbench::fluid {
namespace {

using Record = std::array<double, lanes>;

/// The state before and after, the solids, and numbers from a fixed seed.
struct World {
    explicit World(glm::ivec3 cells, Sides boxSides = openOverFloor)
        : layout(cells),
          sides(boxSides),
          from(layout, ledger.account("a")),
          to(layout, ledger.account("b")),
          solids(layout, sides, ledger.account("c")) {}

    void fillRandom(float speed) {
        std::uniform_real_distribution<float> value(-1, 1);
        for (std::size_t at = 0; at < layout.padded(); ++at)
            for (std::size_t lane = 0; lane < lanes; ++lane)
                from.cell(at)[lane] = value(random) * (lane < 3 ? speed : 1.0f);
        fillGhosts(from, layout, {sides, {0.3f, 0, 0}, false}, GhostUse::lookUp);
    }
    /// Each cell is solid by chance, and one of many bodies.
    void setRandomSolids(double share) {
        const std::size_t count = layout.rows() * static_cast<std::size_t>(layout.nx);
        std::bernoulli_distribution chance(share);
        std::uniform_real_distribution<float> value(-1, 1);
        inside.resize(count);
        motions.resize(255);
        for (BodyMotion& motion : motions) motion.velocity = {value(random), value(random), value(random)};
        for (std::size_t c = 0; c < count; ++c)
            inside[c] = chance(random) ? static_cast<std::uint8_t>(1 + c % motions.size()) : 0;
        solids.set({inside, motions}, from);
    }

    std::mt19937 random{7};
    MemoryLedger ledger;
    CellLayout layout;
    Sides sides;
    CellField from, to;
    SolidCells solids;
    std::vector<std::uint8_t> inside;
    std::vector<BodyMotion> motions;
};

// Trilinear look-up at a place in cells from the first ghost's centre.
Record look(const std::vector<Record>& field, const CellLayout& layout, glm::dvec3 place, Record* least = nullptr,
            Record* most = nullptr) {
    const glm::ivec3 cell = glm::min(glm::ivec3(place), glm::ivec3(layout.nx, layout.ny, layout.nz));
    const glm::dvec3 f = place - glm::dvec3(cell);
    Record sum{};
    if (least) least->fill(1e9), most->fill(-1e9);
    for (int c = 0; c < 8; ++c) {
        const glm::ivec3 corner(c & 1, c >> 1 & 1, c >> 2);
        const Record& record = field[layout.at(cell.x + corner.x - 1, cell.y + corner.y - 1, cell.z + corner.z - 1)];
        double weight = 1;
        for (int axis = 0; axis < 3; ++axis) weight *= corner[axis] != 0 ? f[axis] : 1 - f[axis];
        for (std::size_t lane = 0; lane < lanes; ++lane) {
            sum[lane] += weight * record[lane];
            if (!least) continue;
            (*least)[lane] = std::min((*least)[lane], record[lane]);
            (*most)[lane] = std::max((*most)[lane], record[lane]);
        }
    }
    return sum;
}

/// φ = φ̂ + ½(φⁿ − φ̃), clamped; in double, with whole fields.
std::vector<Record> advectSlowly(const World& world, AdvectionRule rule, double step, double mostCellsZ) {
    const CellLayout& layout = world.layout;
    std::vector<Record> field(layout.padded()), guess, result;
    for (std::size_t at = 0; at < layout.padded(); ++at)
        for (std::size_t lane = 0; lane < lanes; ++lane)
            field[at][lane] = static_cast<double>(world.from.cell(at)[lane]);
    const glm::dvec3 top(layout.nx + 1, layout.ny + 1, layout.nz + 1);
    const auto velocityAt = [&](glm::dvec3 place) {
        const Record record = look(field, layout, place);
        return glm::dvec3(record[0], record[1], record[2]);
    };
    const auto path = [&](glm::dvec3 from, double seconds) {
        const glm::dvec3 middle = glm::clamp(from + 0.5 * seconds * velocityAt(from), glm::dvec3(0), top);
        return from + seconds * velocityAt(middle);
    };
    const auto forAll = [&](const auto& cell) {
        for (int k = 0; k < layout.nz; ++k)
            for (int j = 0; j < layout.ny; ++j)
                for (int i = 0; i < layout.nx; ++i) {
                    const std::size_t at = layout.at(i, j, k);
                    if (world.solids.conductance()[at] == 1) cell(at, glm::dvec3(i + 1, j + 1, k + 1));
                }
    };
    guess = field;
    forAll([&](std::size_t at, glm::dvec3 x) {
        guess[at] = look(field, layout, glm::clamp(path(x, -step), glm::dvec3(0), top));
    });
    if (rule.scheme == AdvectionScheme::semiLagrangian) return guess;
    result = guess;
    forAll([&](std::size_t at, glm::dvec3 x) {
        const Record own = field[at];
        const glm::dvec3 behind = glm::clamp(path(x, -step), glm::dvec3(0), top);
        const glm::dvec3 ahead = behind + 2 * step * glm::dvec3(own[0], own[1], own[2]);
        const auto outside = [&](glm::dvec3 place) {
            return glm::any(glm::lessThan(place, glm::dvec3(1))) || glm::any(glm::greaterThan(place, top - 1.0));
        };
        if (outside(ahead) || outside(behind) || std::fabs(ahead.z - x.z) > mostCellsZ + 1) return;
        Record least, most;
        look(field, layout, behind, &least, &most);
        const Record again = look(guess, layout, ahead);
        for (std::size_t lane = 0; lane < lanes; ++lane) {
            result[at][lane] += 0.5 * (field[at][lane] - again[lane]);
            const double within = std::clamp(result[at][lane], least[lane], most[lane]);
            if (rule.limit == Limit::clamp) result[at][lane] = within;
            if (rule.limit == Limit::revert && result[at][lane] != within) result[at][lane] = guess[at][lane];
        }
    });
    return result;
}

TEST(Advection, EqualsTheSlowVersion) {
    for (const float speed : {0.4f, 1.7f, 9.0f})
        for (const AdvectionRule rule : {AdvectionRule{AdvectionScheme::semiLagrangian, Limit::none},
                                         AdvectionRule{AdvectionScheme::macCormack, Limit::clamp},
                                         AdvectionRule{AdvectionScheme::macCormack, Limit::revert},
                                         AdvectionRule{AdvectionScheme::macCormack, Limit::none}}) {
            World world({13, 9, 27});
            world.fillRandom(speed);
            world.setRandomSolids(0.1);
            Advection advection(world.layout, world.ledger.account("window"));
            advection.advect(world.from, world.to, world.solids.conductance(), rule, 0.9f, std::max(speed, 1.0f));
            const std::vector<Record> slow =
                advectSlowly(world, rule, 0.9, std::ceil(0.9 * static_cast<double>(std::max(speed, 1.0f))));
            // A place on the border between two cells may fall to either side, where the extrema jump.
            int different = 0;
            for (int k = 0; k < 27; ++k)
                for (int j = 0; j < 9; ++j)
                    for (int i = 0; i < 13; ++i)
                        for (std::size_t lane = 0; lane < lanes; ++lane) {
                            const std::size_t at = world.layout.at(i, j, k);
                            const double error =
                                std::fabs(static_cast<double>(world.to.cell(at)[lane]) - slow[at][lane]);
                            if (error > 2e-5 * std::max(1.0, static_cast<double>(speed * speed))) ++different;
                        }
            EXPECT_LE(different, 6) << "speed " << speed << " limit " << static_cast<int>(rule.limit);
        }
}

TEST(Forces, CurlOfARigidRotationIsTwiceItsSpeed) {
    World world({10, 8, 6});
    for (int k = -1; k <= 6; ++k)
        for (int j = -1; j <= 8; ++j)
            for (int i = -1; i <= 10; ++i) {
                const glm::vec3 v = glm::cross(glm::vec3(0.5f, -1, 2), 0.25f * glm::vec3(i, j, k));
                for (int axis = 0; axis < 3; ++axis) world.from.cell(world.layout.at(i, j, k))[axis] = v[axis];
            }
    std::vector<float> curl(forceFloats(world.layout));
    gatherCurl(world.from, world.layout, world.solids.conductance(), 0.25f, curl);
    const std::size_t count = curl.size() / 4;
    for (std::size_t c = 0; c < count; ++c) {
        EXPECT_NEAR(curl[c], 1, 1e-5);
        EXPECT_NEAR(curl[count + c], -2, 1e-5);
        EXPECT_NEAR(curl[2 * count + c], 4, 1e-5);
        EXPECT_NEAR(curl[3 * count + c], std::sqrt(21.0f), 1e-5);
    }
}

TEST(Forces, ConfinementTurnsAroundAVortexRing) {
    // A vortex along z: the force pushes along N × ω, which feeds the rotation where |ω| falls off outwards.
    World world({16, 16, 4}, closed);
    const auto swirl = [](int i, int j) {
        const glm::vec2 d(static_cast<float>(i) - 7.5f, static_cast<float>(j) - 7.5f);
        return glm::vec2(-d.y, d.x) * std::exp(-glm::dot(d, d) / 8);
    };
    for (int k = -1; k <= 4; ++k)
        for (int j = -1; j <= 16; ++j)
            for (int i = -1; i <= 16; ++i) {
                world.from.cell(world.layout.at(i, j, k))[0] = swirl(i, j).x;
                world.from.cell(world.layout.at(i, j, k))[1] = swirl(i, j).y;
            }
    std::vector<float> borrowed(forceFloats(world.layout));
    ForceSettings forces;
    forces.confinementPerSecond = 0.5f;
    applyForces(world.from, world.layout, world.solids.conductance(), forces, 1, 0.1f, borrowed);
    double fed = 0;
    for (int j = 0; j < 16; ++j)
        for (int i = 0; i < 16; ++i) {
            const float* after = world.from.cell(world.layout.at(i, j, 1));
            fed += static_cast<double>(glm::dot(glm::vec2(after[0], after[1]) - swirl(i, j), swirl(i, j)));
            // |f| = ε·h·|N × ω| ≤ ε·h·|ω|, and |ω| ≤ 2 here.
            EXPECT_LE(glm::length(glm::vec2(after[0], after[1]) - swirl(i, j)), 0.5f * 2 * 0.1f + 1e-6f);
        }
    EXPECT_GT(fed, 0.1);
}

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
    std::vector<float> memory(solver.floatsNeeded(), 1e30f);
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
                EXPECT_LE(solved.result.cycles, share < 0.1 ? 10 : 20) << cells.x << " share " << share;
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
