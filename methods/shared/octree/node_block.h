// The nodes of an octree in memory: the eight children of one node lie side by side, one cache line.
#pragma once

#include <array>
#include <cstdint>

namespace dustbench::octree {

/// One node. A node exists where it has a voxel or children; it may have both.
struct NodeSlot {
    std::uint32_t children = 0;  ///< index of the block of its children; 0: none (block 0 is that of the root's)
    std::uint32_t voxel = 0;     ///< index of its voxel + 1; 0: none
};

/// The children of one node by octant, 4·x + 2·y + z of the half in which they lie. Block 0 holds the root's.
struct alignas(64) NodeBlock {
    std::array<NodeSlot, 8> slots;
};
static_assert(sizeof(NodeBlock) == 64);

}  // namespace dustbench::octree
