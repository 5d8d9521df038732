// Compares velocities at the centres, of the state and extrapolated to the middle of a step, with their equations.
#include "methods/grid_fluid/flow/centre_velocities.h"

#include <gtest/gtest.h>

#include <vector>

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

}  // namespace
}  // namespace dustbench::grid_fluid::flow
