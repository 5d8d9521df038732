// A box with random flow and random solids, for the tests of the kernels.
#pragma once

#include <cstdint>
#include <random>
#include <vector>

#include "methods/grid_fluid/flow/box_ghosts.h"
#include "methods/grid_fluid/flow/cell_field.h"
#include "methods/grid_fluid/flow/solid_cells.h"

namespace dustbench::grid_fluid::flow {

/// The states before and after, the solids, and a random generator with a fixed seed.
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
        setSideFaces(from, layout, ghostRule());
        fillGhosts(from, layout, ghostRule());
    }
    [[nodiscard]] GhostRule ghostRule() const { return {sides, {0.3f, 0, 0}, false}; }
    /// Makes each cell solid with probability `share`, as part of one of many bodies.
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

}  // namespace dustbench::grid_fluid::flow
