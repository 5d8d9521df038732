// The nodes of an octree in memory: the eight children of one node lie side by side, one cache line; finest cells need
// no nodes of their own.
//
// Threads: pure.
#pragma once

#include <array>
#include <bit>
#include <cstdint>

namespace dustbench::octree {

/// One node. A node exists where it has a voxel or children; it may have both.
///
/// Children that are finest cells have a voxel and nothing else. Where voxels are numbered in pre-order they follow the
/// node's own one, and a bit for each says all: the node has a family instead of a block.
struct NodeSlot {
    /// Marks a family. With it: in the lowest eight bits a bit for each child, and whether the node has a voxel too.
    static constexpr std::uint32_t familyFlag = 1u << 31, ownVoxelFlag = 1u << 8;

    std::uint32_t children = 0;  ///< index of their block; 0: none (block 0 is that of the root's); or a family
    std::uint32_t voxel = 0;     ///< index of its voxel + 1; 0: none. Of a family the first voxel, its own or a child's

    [[nodiscard]] bool exists() const { return (children | voxel) != 0; }
    [[nodiscard]] bool hasFamily() const { return (children & familyFlag) != 0; }
    [[nodiscard]] bool hasVoxel() const { return hasFamily() ? (children & ownVoxelFlag) != 0 : voxel != 0; }
    /// How many children there are in a family.
    [[nodiscard]] std::uint32_t familySize() const { return static_cast<std::uint32_t>(std::popcount(children & 255)); }
    /// The node of a family's child; there may be none.
    [[nodiscard]] NodeSlot familyChild(std::size_t octant) const {
        if ((children >> octant & 1) == 0) return {};
        const std::uint32_t before = children & ((1u << octant) - 1);
        return {0, voxel + (hasVoxel() ? 1 : 0) + static_cast<std::uint32_t>(std::popcount(before))};
    }
};

/// The children of one node by octant, 4·x + 2·y + z of the half in which they lie. Block 0 holds the root's.
struct alignas(64) NodeBlock {
    std::array<NodeSlot, 8> slots;

    /// A child of a node whose children lie in a block or in a family.
    [[nodiscard]] static NodeSlot childOf(const NodeSlot& node, std::size_t octant, const NodeBlock* blocks) {
        return node.hasFamily() ? node.familyChild(octant) : blocks[node.children].slots[octant];
    }
};
static_assert(sizeof(NodeBlock) == 64);

}  // namespace dustbench::octree
