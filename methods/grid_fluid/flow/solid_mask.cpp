#include "methods/grid_fluid/flow/solid_mask.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <string>

#include "methods/contract/errors.h"

namespace dustbench::grid_fluid::flow {
namespace {

std::uint8_t beyond(Side side) {
    return side == Side::open ? 2 : 0;
}

}  // namespace

void check(const SolidMask& mask, const CellLayout& layout) {
    const std::size_t count = layout.rows() * static_cast<std::size_t>(layout.nx);
    if (!mask.body.empty() && mask.body.size() != count)
        throw InputError("solids: got " + std::to_string(mask.body.size()) +
                         " cells, allowed: " + std::to_string(count) + ", as many as the grid has");
    if (!mask.body.empty() && std::find(mask.body.begin(), mask.body.end(), 0) == mask.body.end())
        throw InputError("solids: the whole box is solid, expected at least one cell of fluid");
    for (std::size_t n = 0; n < mask.motions.size(); ++n) {
        const BodyMotion& motion = mask.motions[n];
        const glm::vec3 all = motion.velocity + motion.turnPerCell + motion.centreCells;
        if (!std::isfinite(all.x + all.y + all.z))
            throw InputError("solids: got a motion of solid " + std::to_string(n + 1) +
                             " that is not finite, allowed: metres per second");
        if (motion.byCell && mask.velocities.size() != count)
            throw InputError("solids: got the velocities of " + std::to_string(mask.velocities.size()) +
                             " cells for solid " + std::to_string(n + 1) +
                             ", which deforms, allowed: " + std::to_string(count) + ", as many as the grid has");
    }
    for (std::size_t cell = 0; cell < mask.velocities.size() && !mask.body.empty(); ++cell) {
        const glm::vec3& velocity = mask.velocities[cell];
        if (mask.body[cell] != 0 && !std::isfinite(velocity.x + velocity.y + velocity.z))
            throw InputError("solids: got a velocity of cell " + std::to_string(cell) +
                             " that is not finite, allowed: metres per second");
    }
}

void conductEverywhere(const CellLayout& layout, const Sides& sides, std::span<std::uint8_t> conductance) {
    std::fill(conductance.begin(), conductance.end(), std::uint8_t{0});
    const auto fill = [&](int i0, int i1, int j0, int j1, int k0, int k1, std::uint8_t value) {
        for (int k = k0; k < k1; ++k)
            for (int j = j0; j < j1; ++j)
                std::memset(conductance.data() + layout.at(i0, j, k), value, static_cast<std::size_t>(i1 - i0));
    };
    const int nx = layout.nx, ny = layout.ny, nz = layout.nz;
    fill(0, nx, 0, ny, 0, nz, 1);
    fill(-1, 0, 0, ny, 0, nz, beyond(sides[0]));
    fill(nx, nx + 1, 0, ny, 0, nz, beyond(sides[1]));
    fill(0, nx, -1, 0, 0, nz, beyond(sides[2]));
    fill(0, nx, ny, ny + 1, 0, nz, beyond(sides[3]));
    fill(0, nx, 0, ny, -1, 0, beyond(sides[4]));
    fill(0, nx, 0, ny, nz, nz + 1, beyond(sides[5]));
}

}  // namespace dustbench::grid_fluid::flow
