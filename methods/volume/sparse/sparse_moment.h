// A volume at one moment: the box in which rays are marched, and trees of density and fire.
//
// Units: metres; cells of the lattice of a series. Frame: world.
#pragma once

#include <string_view>

#include "methods/kit/raycast/shown_grid.h"
#include "methods/volume/sparse/nano_tree.h"

namespace dustbench::volume {

struct SparseMoment {
    SparseMoment(MemoryLedger& ledger, std::string_view structure)
        : density(ledger.account(structure)), reaction(ledger.account(structure)) {}

    /// Position and size only, as for a dense grid.
    [[nodiscard]] raycast::ShownGrid place() const { return {cells, spacingMetres, originMetres, {}, {}}; }
    /// Everything visible is in [minimum, maximum), in cells of the box.
    [[nodiscard]] glm::ivec3 minimum() const { return glm::max(density.minimum() - firstCell, glm::ivec3(0)); }
    [[nodiscard]] glm::ivec3 maximum() const { return glm::min(density.maximum() - firstCell + 1, cells); }

    glm::ivec3 cells{0};
    double spacingMetres = 0;
    glm::dvec3 originMetres{0};  ///< minimum corner of the box
    glm::ivec3 firstCell{0};     ///< of the box, on the lattice
    NanoTree density;
    NanoTree reaction;  ///< 1 fresh fire … 0 burnt out; empty: smoke only
};

}  // namespace dustbench::volume
