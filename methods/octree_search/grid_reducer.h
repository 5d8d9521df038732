// Reduces a brick's particles to voxels through a small dense grid of cells: the search principle with a single address
// as the path.
//
// Threads: one at a time.
#pragma once

#include <array>
#include <cstdint>

#include "methods/kit/octree/brick_assembly.h"

namespace dustbench::octree_search {

class GridReducer {
 public:
    static constexpr bool needsSpare = false;

    explicit GridReducer(const octree::VoxelRule& rule) : rule_(rule) {}

    /// Called by BrickBuilder.
    void reduce(const octree::BrickPartition& partition, const octree::Brick& brick, const octree::BrickVoxels& voxels);

 private:
    octree::VoxelRule rule_;
    /// By place: the best particle's key; 0: none. Keys are never 0.
    std::array<std::uint64_t, octree::placesInBrick> best_{};
    static constexpr std::size_t bits = 64 * std::tuple_size_v<octree::PlaceBits>;
    std::array<std::uint8_t, bits> isTaken_{};    ///< by place: whether `best_` has a key; an eighth of its size
    std::array<std::uint16_t, bits + 31> taken_;  ///< the places that have a key
    std::array<double, octree::placesInBrick> sums_;
};

}  // namespace dustbench::octree_search
