// Reduces a brick's particles to voxels by sorting their Morton codes: equivalent to splitting lists level by level,
// with all levels done at once.
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

    /// Called by BrickBuilder.
    void reduce(const octree::BrickPartition& partition, const octree::Brick& brick, const octree::BrickVoxels& voxels);

 private:
    octree::VoxelRule rule_;
};

}  // namespace dustbench::octree_recursive
