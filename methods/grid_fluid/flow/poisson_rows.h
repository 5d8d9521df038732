// Loops over the rows of a split grid, and access to a row's neighbours and faces. Internal to the pressure kernels.
//
// Threads: rows in blocks.
#pragma once

#include <atomic>
#include <cstddef>

#include "methods/grid_fluid/flow/lanes.h"
#include "methods/grid_fluid/flow/poisson_level.h"
#include "methods/kit/parallel/for_each_block.h"

namespace dustbench::grid_fluid::flow {

template <typename Row>
void forRows(const SplitLayout& layout, const Row& row) {
    parallel::forEachBlock(layout.rows(), layout.rowsInABlock(), [&](std::size_t first, std::size_t count) {
        for (std::size_t r = first; r < first + count; ++r) row(layout.rowJ(r), layout.rowK(r));
    });
}

/// Neighbours of a row of one colour: x from the other colour in the same row, y and z from the adjacent rows.
struct Around {
    const float *here, *beside, *below, *above, *near, *far;

    /// For sixteen cells, the sum over the six neighbours of each.
    [[gnu::always_inline]] [[nodiscard]] Float16 sixteen(std::size_t m) const {
        const auto at = [m](const float* row) { return load<Float16>(row + m); };
        return (at(here) + at(beside)) + (at(below) + at(above)) + (at(near) + at(far));
    }
};

[[nodiscard]] inline Around aroundRow(const SplitLayout& layout, const float* other, int colour, int j, int k) {
    const float* here = other + layout.at(j, k);
    // Cells of this colour begin at i = 0 or i = 1: their neighbours in x have indices m − 1 and m, or m and m + 1.
    const bool odd = ((colour + j + k) & 1) != 0;
    return {
        here, odd ? here + 1 : here - 1, here - layout.row, here + layout.row, here - layout.slab, here + layout.slab};
}

/// Weights of the six faces of a row's cells, in the order of the neighbours.
[[nodiscard]] inline Around facesOfRow(const SplitLayout& layout, const SplitField (&faces)[3], int colour, int j,
                                       int k) {
    const std::size_t at = layout.at(j, k);
    const bool odd = ((colour + j + k) & 1) != 0;
    const float* own = faces[0].colour[colour] + at;
    const float* other = faces[0].colour[1 - colour] + at;
    const float* ownY = faces[1].colour[colour] + at;
    const float* otherY = faces[1].colour[1 - colour] + at;
    const float* ownZ = faces[2].colour[colour] + at;
    const float* otherZ = faces[2].colour[1 - colour] + at;
    // An even cell's next neighbour is m and its previous m − 1; an odd cell's previous is m and its next m + 1.
    return {odd ? other : own, odd ? own : other - 1, otherY - layout.row, ownY, otherZ - layout.slab, ownZ};
}

template <typename Body>
[[gnu::always_inline]] inline void loop(std::size_t count, const Body& body) {
#pragma GCC ivdep
    for (std::size_t m = 0; m < count; ++m) body(m);
}

/// Raises `maximum` to at least `value`.
inline void raiseTo(std::atomic<float>& maximum, float value) {
    float seen = maximum.load(std::memory_order_relaxed);
    while (value > seen && !maximum.compare_exchange_weak(seen, value, std::memory_order_relaxed)) {
    }
}

}  // namespace dustbench::grid_fluid::flow
