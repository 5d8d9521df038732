// Several stages over the slabs of a grid in one pass through memory: each follows a slab behind the one before it,
// while what that one has left is still in the cache.
//
// For stages that read what the stage before left in a slab and in the two beside it, and write into the slab alone, as
// half sweeps of red-black relaxation do. Blocks of slabs are gone through in parallel, each stage a slab narrower at
// either end than the one before; what is left out around each border, a wedge that grows with the stages, follows as
// soon as both sides of it are done. Source: Wellein2009 (wavefronts), Frigo2005 (trapezoids). Threads: uses the
// current oneTBB arena. Any number of blocks has the same result.
#pragma once

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <memory>

#include "methods/kit/parallel/for_each_block.h"

namespace dustbench::parallel {

/// `stage(number, slab)` for every stage of every slab, in an order in which each finds the stage before done in its
/// slab and beside it, and the stage after not yet begun there.
template <typename Stage>
void forStages(std::size_t slabs, std::size_t stages, std::size_t maximumBlocks, const Stage& stage) {
    const std::size_t last = stages - 1;
    // Wedges do not overlap.
    const std::size_t blocks = std::clamp<std::size_t>(slabs / std::max<std::size_t>(1, 2 * last), 1, maximumBlocks);
    // A block does the wedge at its end as well, if nobody is late. That is as much work as its own stages leave out at
    // both ends; the first leaves out nothing at one of them, and the last has no wedge.
    const auto border = [&](std::size_t block) {
        return block == 0 ? 0 : block == blocks ? slabs : block * slabs / blocks - last / 2;
    };
    // A wedge waits for the end of the block before it and for the beginning of that behind it: who is second does it.
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
