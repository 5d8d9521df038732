// Sort keys of particles up to depth 8: bin and place in the brick in one 32-bit word.
//
// Bins are the bricks in Morton order, followed by one bin for voxels above the bricks and one for particles outside
// the world. Threads: pure.
#pragma once

#include <cstddef>
#include <cstdint>

#include "methods/kit/octree/brick_nodes.h"
#include "methods/kit/octree/cell_kernel.h"

namespace dustbench::octree {

/// Up to this depth there are few enough bricks to use as bins.
inline constexpr int narrowDepth = 8;

[[nodiscard]] constexpr std::uint32_t narrowBin(std::uint32_t key) {
    return key >> brickPlaceBits;
}
[[nodiscard]] constexpr std::uint32_t narrowPlace(std::uint32_t key) {
    return key & ((1u << brickPlaceBits) - 1);
}

/// Keys of particles `first` to `first + count`, with `bricks` bricks in total. For particles outside the world and
/// voxels above the bricks only the bin is meaningful.
template <LevelRule rule>
void makeNarrowKeys(const CellKernel<rule>& kernel, std::size_t first, std::size_t count, std::uint32_t bricks,
                    std::uint32_t* keys);

/// The same for a single particle: simple and slow.
template <LevelRule rule>
[[nodiscard]] std::uint32_t narrowKey(const CellKernel<rule>& kernel, std::size_t particle, std::uint32_t bricks) {
    const ParticleCell cell = kernel(particle);
    const std::uint32_t inTree = (cell.brickCode & ~cell.aboveBricks) | (bricks & cell.aboveBricks);
    const std::uint32_t bin = (inTree & ~cell.outside) | ((bricks + 1) & cell.outside);
    return bin << brickPlaceBits | placeInBrick(cell.localCode, cell.rise);
}

}  // namespace dustbench::octree
