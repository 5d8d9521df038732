// Iterates over rows in tiles, so that adjacent rows in y and z are still cached when their neighbours are processed.
// Internal to the kernels.
//
// Threads: tiles in parallel.
#pragma once

#include <algorithm>
#include <cstddef>

#include "methods/grid_fluid/flow/cell_field.h"
#include "methods/kit/parallel/for_each_block.h"

namespace dustbench::grid_fluid::flow {

/// Calls `row(j, k, scratch)` for every row of a box; the rows of a tile share one `Scratch`, initially `Scratch{}`,
/// and `done(scratch)` follows its last.
template <typename Scratch, typename Row, typename Done>
void forRowsInTiles(const CellLayout& layout, const Row& row, const Done& done) {
    constexpr int side = 16;  // for rows of 256 cells, three slabs of a tile are a third of a megabyte
    const int tilesJ = (layout.ny + side - 1) / side, tilesK = (layout.nz + side - 1) / side;
    const auto tiles = static_cast<std::size_t>(tilesJ) * static_cast<std::size_t>(tilesK);
    parallel::forEachBlock(tiles, 1, [&](std::size_t tile, std::size_t) {
        const int firstJ = static_cast<int>(tile) % tilesJ * side, firstK = static_cast<int>(tile) / tilesJ * side;
        Scratch scratch{};
        for (int k = firstK; k < std::min(firstK + side, layout.nz); ++k)
            for (int j = firstJ; j < std::min(firstJ + side, layout.ny); ++j) row(j, k, scratch);
        done(scratch);
    });
}

template <typename Scratch, typename Row>
void forRowsInTiles(const CellLayout& layout, const Row& row) {
    forRowsInTiles<Scratch>(layout, row, [](const Scratch&) {});
}

}  // namespace dustbench::grid_fluid::flow
