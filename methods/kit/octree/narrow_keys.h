// What particles are sorted into bricks by, down to depth 8: bin and place in the brick as one word of 32 bits.
//
// Bins are the bricks in Morton order; behind them one for voxels above the bricks and one for particles outside the
// world. Threads: pure.
#pragma once

#include <cstddef>
#include <cstdint>

#include "methods/kit/octree/brick_nodes.h"
#include "methods/kit/octree/cell_kernel.h"

namespace dustbench::octree {

/// Up to this depth bricks are few enough to be bins.
inline constexpr int narrowDepth = 8;

[[nodiscard]] constexpr std::uint32_t narrowBin(std::uint32_t key) {
    return key >> brickPlaceBits;
}
[[nodiscard]] constexpr std::uint32_t narrowPlace(std::uint32_t key) {
    return key & ((1u << brickPlaceBits) - 1);
}

/// Keys of the particles `first` to `first + count`, where there are `bricks` bricks in all. Of particles outside the
/// world and of voxels above the bricks only the bin counts.
template <LevelRule rule>
void makeNarrowKeys(const CellKernel<rule>& kernel, std::size_t first, std::size_t count, std::uint32_t bricks,
                    std::uint32_t* keys);

/// The same for one of them: slow and clear.
template <LevelRule rule>
[[nodiscard]] std::uint32_t narrowKey(const CellKernel<rule>& kernel, std::size_t particle, std::uint32_t bricks) {
    const ParticleCell cell = kernel(particle);
    const std::uint32_t inTree = (cell.brickCode & ~cell.aboveBricks) | (bricks & cell.aboveBricks);
    const std::uint32_t bin = (inTree & ~cell.outside) | ((bricks + 1) & cell.outside);
    return bin << brickPlaceBits | placeInBrick(cell.localCode, cell.rise);
}

}  // namespace dustbench::octree
