// Compares advection, forces and velocities at the centres with simple reference implementations and equations.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "methods/grid_fluid/flow/centre_velocities.h"
#include "methods/grid_fluid/flow/curl.h"
#include "methods/grid_fluid/flow/forces.h"
#include "methods/grid_fluid/flow/kernels_test_world.h"
#include "methods/grid_fluid/flow/plain_advection.h"

namespace dustbench::grid_fluid::flow {
namespace {

constexpr glm::ivec3 odd{13, 5, 6};  // rows of three times four cells and one more

/// Calls `take(cell)` for the cells of the box and the ghosts around it.
template <typename Take>
void forPaddedCells(const Take& take) {
    for (glm::ivec3 c(-1); c.z <= odd.z; ++c.z)
        for (c.y = -1; c.y <= odd.y; ++c.y)
            for (c.x = -1; c.x <= odd.x; ++c.x) take(c);
}

/// Computes them row by row, and compares each with `expected(cell, axis)`.
template <typename Expected>
void expectThem(CentreVelocities& velocities, const CellField& cells, const CellLayout& layout,
                const Extrapolation* extrapolation, const Expected& expected) {
    velocities.hold(static_cast<std::size_t>(odd.z) + 2);
    velocities.keepLast();
    for (std::size_t r = 0; r < layout.rows(); ++r)
        velocities.findRow(cells, extrapolation, layout.rowJ(r), layout.rowK(r));
    forPaddedCells([&](glm::ivec3 c) {
        for (int axis = 0; axis < 3; ++axis)
            ASSERT_NEAR(velocities.slab(c.z)[4 * layout.at(c.x, c.y, -1) + static_cast<std::size_t>(axis)],
                        expected(c, axis), 1e-6)
                << axis << " at " << c.x << ' ' << c.y << ' ' << c.z;
    });
}

TEST(CentreVelocities, AreMeansOfFacesAndExtrapolatedFromTheLastOnesThatMovedWithTheBox) {
    constexpr float ahead = 0.75f;
    const glm::vec3 wind(0.3f, -0.1f, 0.2f), most(0.9f, 0.8f, 0.7f);
    for (const glm::ivec3 by :
         {glm::ivec3(0), {3, 0, -2}, {-4, 1, 0}, {1, -2, 3}, {0, 0, 7}, {-13, 0, 1}, {20, -9, 0}}) {
        World world(odd);
        CentreVelocities velocities(world.layout, world.ledger.account("velocities"));
        world.fillRandom(1);
        const std::vector<glm::dvec3> first = plainCentres(world.from, world.layout);
        const auto at = [&](glm::ivec3 c) { return world.layout.at(c.x, c.y, c.z); };
        const Extrapolation none{0, glm::vec3(1)}, half{ahead, most};
        expectThem(velocities, world.from, world.layout, &none,
                   [&](glm::ivec3 c, int axis) { return first[at(c)][axis]; });

        velocities.scroll(by, wind);
        world.fillRandom(1);
        const std::vector<glm::dvec3> second = plainCentres(world.from, world.layout);
        expectThem(velocities, world.from, world.layout, &half, [&](glm::ivec3 c, int axis) {
            const glm::ivec3 own = glm::clamp(c, glm::ivec3(0), odd - 1), from = own + by;
            const bool had = glm::all(glm::greaterThanEqual(from, glm::ivec3(0))) && glm::all(glm::lessThan(from, odd));
            const double now = second[at(c)][axis], limit = static_cast<double>(most[axis]),
                         last = had ? first[at(from)][axis] : static_cast<double>(wind[axis]);
            return glm::clamp(now + static_cast<double>(ahead) * (now - last), -limit, limit);
        });
        expectThem(velocities, world.from, world.layout, nullptr,
                   [&](glm::ivec3 c, int axis) { return second[at(c)][axis]; });
    }
}

constexpr std::array allRules{AdvectionRule{AdvectionScheme::semiLagrangian, Limit::none},
                              AdvectionRule{AdvectionScheme::macCormack, Limit::clamp},
                              AdvectionRule{AdvectionScheme::macCormack, Limit::revert},
                              AdvectionRule{AdvectionScheme::macCormack, Limit::none}};

/// Values that differ from those of the reference implementation. A position on the border of two cells may be rounded
/// to either side, where the extrema differ.
int differing(const World& world, const std::vector<PlainRecord>& plain, float speed) {
    int different = 0;
    for (int k = 0; k < world.layout.nz; ++k)
        for (int j = 0; j < world.layout.ny; ++j)
            for (int i = 0; i < world.layout.nx; ++i)
                for (std::size_t lane = 0; lane < lanes; ++lane) {
                    const std::size_t at = world.layout.at(i, j, k);
                    const double error = std::fabs(static_cast<double>(world.from.cell(at)[lane]) - plain[at][lane]);
                    if (error > 2e-5 * std::max(1.0, static_cast<double>(speed * speed))) ++different;
                }
    return different;
}

TEST(Advection, EqualsThePlainOne) {
    for (const float speed : {0.4f, 1.7f, 9.0f})
        for (const AdvectionRule rule : allRules) {
            World world({13, 9, 27});
            world.fillRandom(speed);
            world.setRandomSolids(0.1);
            Advection advection(world.layout, world.ledger.account("window"));
            const float maximum = std::max(speed, 1.0f);
            const std::vector<PlainRecord> plain = plainAdvection(world.from, world.layout, world.solids.moving(), rule,
                                                                  0.9, static_cast<double>(maximum));
            advection.advect(world.from, world.to, world.solids.moving(), rule, {0.9f, glm::vec3(maximum)});
            EXPECT_LE(differing(world, plain, speed), 6)
                << "speed " << speed << " limit " << static_cast<int>(rule.limit);
        }
}

TEST(Advection, AlongThePathsOfTheMiddleOfTheStepEqualsThePlainOne) {
    for (const float speed : {0.4f, 1.7f, 9.0f})
        for (AdvectionRule rule : allRules) {
            rule.velocityAt = VelocityAt::middle;
            World world({13, 9, 27});
            Advection advection(world.layout, world.ledger.account("window"));
            const float maximum = std::max(speed, 1.0f);
            PlainExtrapolation extrapolation{{}, 0.4, glm::dvec3(static_cast<double>(maximum))};
            for (const bool isFirst : {true, false}) {
                world.fillRandom(speed);
                if (isFirst) world.setRandomSolids(0.1);
                const std::vector<glm::dvec3> centres = plainCentres(world.from, world.layout);
                const std::vector<PlainRecord> plain =
                    plainAdvection(world.from, world.layout, world.solids.moving(), rule, 0.9,
                                   static_cast<double>(maximum), isFirst ? nullptr : &extrapolation);
                advection.advect(world.from, world.to, world.solids.moving(), rule,
                                 {0.9f, glm::vec3(maximum), isFirst ? 0 : 0.4f});
                EXPECT_LE(differing(world, plain, speed), 6) << "speed " << speed << (isFirst ? " first" : " second");
                extrapolation.last = centres;
            }
        }
}

TEST(SolidCells, FacesHaveTheSpeedOfTheSolidAheadElseOfThatBehind) {
    const glm::ivec3 size(37, 9, 11);
    for (const double share : {0.002, 0.02, 0.4}) {  // rows with few solids or none are skipped early
        World world(size);
        world.fillRandom(1);
        std::vector<float> before(world.from.data(), world.from.data() + world.from.floats());
        world.setRandomSolids(share);
        const auto solidAt = [&](glm::ivec3 cell) -> int {
            if (glm::any(glm::lessThan(cell, glm::ivec3(0))) || glm::any(glm::greaterThanEqual(cell, size))) return 0;
            return world.inside[static_cast<std::size_t>((cell.z * size.y + cell.y) * size.x + cell.x)];
        };
        for (int axis = 0; axis < 3; ++axis) {
            glm::ivec3 faces = size;
            faces[axis] += 1;
            for (glm::ivec3 at(0); at.z < faces.z; ++at.z)
                for (at.y = 0; at.y < faces.y; ++at.y)
                    for (at.x = 0; at.x < faces.x; ++at.x) {
                        glm::ivec3 behind = at;
                        behind[axis] -= 1;
                        const int solid = solidAt(at) != 0 ? solidAt(at) : solidAt(behind);
                        const std::size_t lane =
                            world.layout.at(at.x, at.y, at.z) * lanes + static_cast<std::size_t>(axis);
                        const float expected = solid != 0
                                                   ? world.motions[static_cast<std::size_t>(solid - 1)].velocity[axis]
                                                   : before[lane];
                        ASSERT_EQ(world.from.data()[lane], expected)
                            << axis << " at " << at.x << ' ' << at.y << ' ' << at.z;
                    }
        }
        for (glm::ivec3 at(0); at.z < size.z; ++at.z)
            for (at.y = 0; at.y < size.y; ++at.y)
                for (at.x = 0; at.x < size.x; ++at.x) {
                    const auto flows = [&](glm::ivec3 cell) {
                        return world.solids.conductance()[world.layout.at(cell.x, cell.y, cell.z)] == 1;
                    };
                    int expected = 8;
                    for (int axis = 0; axis < 3; ++axis) {
                        glm::ivec3 behind = at;
                        behind[axis] -= 1;
                        if (flows(behind)) expected |= 1 << axis;
                    }
                    ASSERT_EQ(world.solids.moving()[world.layout.at(at.x, at.y, at.z)], flows(at) ? expected : 0);
                }
    }
}

TEST(Forces, CurlOfARigidRotationIsTwiceItsSpeed) {
    World world({10, 8, 6});
    for (int k = -1; k <= 6; ++k)
        for (int j = -1; j <= 8; ++j)
            for (int i = -1; i <= 10; ++i) {
                for (int axis = 0; axis < 3; ++axis) {
                    glm::vec3 face(i, j, k);
                    face[axis] -= 0.5f;
                    world.from.cell(world.layout.at(i, j, k))[axis] =
                        glm::cross(glm::vec3(0.5f, -1, 2), 0.25f * face)[axis];
                }
            }
    std::vector<float> memory(CurlField::floats(world.layout));
    CurlField field(world.layout, memory);
    for (int k = 0; k < 6; ++k) field.findSpeeds(world.from, k);
    for (int k = 0; k < 6; ++k) field.findCurl(world.solids.conductance(), 0.25f, k);
    for (int k = 0; k < 6; ++k) field.findLength(k);
    for (int k = 0; k < 6; ++k)
        for (int j = 0; j < 8; ++j)
            for (std::size_t i = 0; i < 10; ++i) {
                const std::size_t at = field.row(j, k) + i;
                EXPECT_NEAR(field.curl()[0][at], 1, 1e-5);
                EXPECT_NEAR(field.curl()[1][at], -2, 1e-5);
                EXPECT_NEAR(field.curl()[2][at], 4, 1e-5);
                EXPECT_NEAR(field.length(j, k)[i], std::sqrt(21.0f), 1e-5);
            }
}

TEST(Forces, ConfinementTurnsAroundAVortexRing) {
    // A vortex along z. The force acts along N × ω and strengthens the rotation where |ω| decreases outwards.
    World world({16, 16, 4}, closed);
    const auto at = [](float x, float y) {
        const glm::vec2 d(x - 7.5f, y - 7.5f);
        return glm::vec2(-d.y, d.x) * std::exp(-glm::dot(d, d) / 8);
    };
    const auto swirl = [&](int i, int j) {  // on the faces
        const auto x = static_cast<float>(i), y = static_cast<float>(j);
        return glm::vec2(at(x - 0.5f, y).x, at(x, y - 0.5f).y);
    };
    for (int k = -1; k <= 4; ++k)
        for (int j = -1; j <= 16; ++j)
            for (int i = -1; i <= 16; ++i) {
                world.from.cell(world.layout.at(i, j, k))[0] = swirl(i, j).x;
                world.from.cell(world.layout.at(i, j, k))[1] = swirl(i, j).y;
            }
    (void)world.solids.set({}, world.from);
    std::vector<float> borrowed(forceFloats(world.layout));
    ForceSettings forces;
    forces.confinementPerSecond = 0.5f;
    applyForces(world.from, world.layout, world.solids.conductance(), world.solids.moving(), forces, 1, 0.1f, borrowed);
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

/// The equations of the forces, in double precision; they act on the state `before`.
struct SlowForces {
    const World& world;
    const CellField& before;
    const ForceSettings& settings;
    double h, dt;

    [[nodiscard]] std::size_t index(glm::ivec3 c) const { return world.layout.at(c.x, c.y, c.z); }
    [[nodiscard]] double of(glm::ivec3 c, std::size_t lane) const {
        return static_cast<double>(before.cell(index(c))[lane]);
    }
    /// The speed at a cell's centre: the mean of its two faces.
    [[nodiscard]] double speed(glm::ivec3 c, int component) const {
        glm::ivec3 next = c;
        ++next[component];
        return 0.5 * (of(c, static_cast<std::size_t>(component)) + of(next, static_cast<std::size_t>(component)));
    }
    [[nodiscard]] glm::dvec3 curl(glm::ivec3 cell) const {
        if (world.solids.conductance()[index(cell)] != 1) return glm::dvec3(0);
        const auto slope = [&](int component, int along) {
            glm::ivec3 ahead = cell, back = cell;
            ++ahead[along], --back[along];
            return (speed(ahead, component) - speed(back, component)) / (2 * h);
        };
        return glm::dvec3(slope(2, 1) - slope(1, 2), slope(0, 2) - slope(2, 0), slope(1, 0) - slope(0, 1));
    }
    [[nodiscard]] glm::ivec3 clamped(glm::ivec3 c) const {
        return glm::clamp(c, glm::ivec3(0), glm::ivec3(world.layout.nx, world.layout.ny, world.layout.nz) - 1);
    }
    [[nodiscard]] glm::dvec3 confinement(glm::ivec3 cell) const {
        glm::dvec3 towards;  // direction in which |ω| increases
        for (int axis = 0; axis < 3; ++axis) {
            glm::ivec3 ahead = cell, back = cell;
            ++ahead[axis], --back[axis];
            towards[axis] = glm::length(curl(clamped(ahead))) - glm::length(curl(clamped(back)));
        }
        const double epsilon = static_cast<double>(settings.confinementPerSecond);
        if (!(glm::length(towards) > 0)) return glm::dvec3(0);
        return epsilon * h * glm::cross(glm::normalize(towards), curl(cell));
    }
    /// At the centre of a cell, or of the nearest cell of the box.
    [[nodiscard]] glm::dvec3 force(glm::ivec3 cell) const {
        cell = clamped(cell);
        glm::dvec3 sum(0);
        for (const glm::ivec3 away : around()) {
            const double share =
                0.125 / static_cast<double>(1 << (away.x * away.x + away.y * away.y + away.z * away.z));
            sum += share * confinement(clamped(cell + away));
        }
        sum.y += static_cast<double>(settings.buoyancyPerKelvin) * of(cell, temperature) -
                 static_cast<double>(settings.weightPerDensity) * of(cell, density);
        return sum;
    }
    /// The 27 cells in and around a cell.
    static std::vector<glm::ivec3> around() {
        std::vector<glm::ivec3> all;
        all.reserve(27);
        for (int n = 0; n < 27; ++n) all.emplace_back(n % 3 - 1, n / 3 % 3 - 1, n / 9 - 1);
        return all;
    }
    [[nodiscard]] PlainRecord after(glm::ivec3 cell) const {
        const Moving moving = world.solids.moving()[index(cell)];
        PlainRecord now;
        for (std::size_t lane = 0; lane < lanes; ++lane) now[lane] = of(cell, lane);
        for (int axis = 0; axis < 3; ++axis) {
            glm::ivec3 other = cell;
            --other[axis];
            if ((moving >> axis & 1) != 0)
                now[static_cast<std::size_t>(axis)] += dt * 0.5 * (force(cell)[axis] + force(other)[axis]);
        }
        if ((moving & 8) == 0) return now;
        now[density] *= std::exp(-static_cast<double>(settings.densityDecayPerSecond) * dt);
        now[temperature] *= std::exp(-static_cast<double>(settings.coolingPerSecond) * dt);
        now[reaction] = std::max(0.0, now[reaction] - static_cast<double>(settings.reactionLossPerSecond) * dt);
        return now;
    }
};

TEST(Forces, EqualTheSlowVersion) {
    const ForceSettings settings{0.1f, 0.2f, 0.5f, 0.3f, 0.4f, 0.6f, 0};
    for (const double share : {0.0, 0.02, 0.3}) {
        World world({53, 7, 5});
        world.fillRandom(1);
        world.setRandomSolids(share);
        const CellField before = world.from;
        std::vector<float> borrowed(forceFloats(world.layout));
        applyForces(world.from, world.layout, world.solids.conductance(), world.solids.moving(), settings, 0.5f, 0.1f,
                    borrowed);
        for (int k = 0; k < world.layout.nz; ++k)
            for (int j = 0; j < world.layout.ny; ++j)
                for (int i = 0; i < world.layout.nx; ++i) {
                    const std::size_t at = world.layout.at(i, j, k);
                    const PlainRecord slow = SlowForces{world, before, settings, 0.5, 0.1}.after({i, j, k});
                    for (std::size_t lane = 0; lane < lanes; ++lane)
                        EXPECT_NEAR(static_cast<double>(world.from.cell(at)[lane]), slow[lane], 2e-5)
                            << i << ' ' << j << ' ' << k << " lane " << lane << " share " << share;
                }
    }
}

}  // namespace
}  // namespace dustbench::grid_fluid::flow
