// A brick's particles to its voxels by sorting them by their Morton codes: what splitting lists level by level comes to
// when all levels are done at once.
//
// Threads: one at a time.
#pragma once

#include <cstdint>

#include "methods/kit/octree/brick_assembly.h"

namespace dustbench::octree_recursive {

class SortingReducer {
 public:
    static constexpr bool needsSpare = true;

    explicit SortingReducer(const octree::VoxelRule& rule) : rule_(rule) {}

    /// As BrickBuilder asks for it.
    void reduce(const octree::BrickPartition& partition, const octree::Brick& brick, const octree::BrickVoxels& voxels);

 private:
    octree::VoxelRule rule_;
};

}  // namespace dustbench::octree_recursive
