// Runs several stages over the slabs of a grid in one pass through memory: each stage follows one slab behind the
// previous stage, whose results are still in the cache.
//
// For stages that read the previous stage's results in a slab and its two neighbours and write only that slab, such as
// half sweeps of red-black relaxation. Blocks of slabs are processed in parallel; within a block each stage is one slab
// narrower at either end than the previous stage. This leaves out a wedge around each border, which grows with the
// stages and is processed as soon as both of its sides are done. Source: Wellein2009 (wavefronts), Frigo2005
// (trapezoids). Threads: uses the current oneTBB arena. The result does not depend on the number of blocks.
#pragma once

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <memory>

#include "methods/kit/parallel/for_each_block.h"

namespace dustbench::parallel {

/// Calls `stage(number, slab)` for every stage of every slab. At each call the previous stage is done in the slab and
/// its neighbours, and the next stage has not begun there.
template <typename Stage>
void forStages(std::size_t slabs, std::size_t stages, std::size_t maximumBlocks, const Stage& stage) {
    const std::size_t last = stages - 1;
    // Wedges must not overlap.
    const std::size_t blocks = std::clamp<std::size_t>(slabs / std::max<std::size_t>(1, 2 * last), 1, maximumBlocks);
    // A block usually also processes the wedge at its end, which is as much work as its own stages leave out at both
    // ends. The first block leaves out nothing at its start, and the last has no wedge at its end, so the borders
    // compensate.
    const auto border = [&](std::size_t block) {
        return block == 0 ? 0 : block == blocks ? slabs : block * slabs / blocks - last / 2;
    };
    // A wedge needs the end of the block before it and the start of the block after it; whichever of the two comes
    // later processes it.
    const std::unique_ptr<std::atomic<int>[]> ready(new std::atomic<int>[blocks]());
    const auto sideIsDone = [&](std::size_t wedge) {
        if (ready[wedge].fetch_add(1) == 0) return;
        const std::size_t middle = border(wedge);
        for (std::size_t s = 1; s <= last; ++s)
            for (std::size_t slab = middle - s; slab < middle + s; ++slab) stage(s, slab);
    };
    forEachBlock(blocks, 1, [&](std::size_t block, std::size_t) {
        const std::size_t first = border(block), end = border(block + 1);
        for (std::size_t front = first; front < end + last; ++front) {
            for (std::size_t s = 0; s <= std::min(last, front - first); ++s) {
                const std::size_t slab = front - s;
                const std::size_t from = first + (block == 0 ? 0 : s), to = end - (block + 1 == blocks ? 0 : s);
                if (slab >= from && slab < to) stage(s, slab);
            }
            if (block != 0 && front == first + 2 * last) sideIsDone(block);
        }
        if (block + 1 != blocks) sideIsDone(block + 1);
    });
}

}  // namespace dustbench::parallel
