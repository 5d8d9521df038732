// Builds trees from bricks.
//
// `spacingMetres`, `originMetres` and `roomBytes` are as in NanoTree::lay.
#pragma once

#include "methods/volume/sparse/bricks.h"
#include "methods/volume/sparse/nano_tree.h"

namespace dustbench::volume {

/// Builds a tree of densities: a leaf for each brick, and tiles where samples reach into other bricks. Threads: runs in
/// parallel.
void plantDensities(const Bricks& densities, double spacingMetres, const glm::dvec3& originMetres,
                    std::size_t roomBytes, NanoTree& tree);

/// Builds a tree of any values: all cells of all bricks are active.
void plantAll(const Bricks& values, double spacingMetres, const glm::dvec3& originMetres, std::size_t roomBytes,
              NanoTree& tree);

/// Whether a cell is active on the upper side of a brick, along the axes whose bits (1, 2, 4) are set.
[[nodiscard]] bool touchesAbove(const CellMask& active, int axes);

}  // namespace dustbench::volume
