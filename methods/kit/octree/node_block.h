// The octree's nodes in memory: the eight children of a node are contiguous in one cache line; finest cells need no
// nodes.
//
// Threads: pure.
#pragma once

#include <array>
#include <bit>
#include <cstdint>

namespace dustbench::octree {

/// One node. A node exists if it has a voxel, children or both.
///
/// Children that are finest cells have only a voxel. With voxels numbered in pre-order, the children's voxels follow
/// the node's own, so one bit per child suffices: the node has a family instead of a block.
struct NodeSlot {
    /// Marks a family. The lowest eight bits then flag the children; ownVoxelFlag is set if the node has a voxel
    /// too.
    static constexpr std::uint32_t familyFlag = 1u << 31, ownVoxelFlag = 1u << 8;

    std::uint32_t children = 0;  ///< index of the children's block, 0: none (block 0 is the root's); or a family
    std::uint32_t voxel = 0;     ///< index of the voxel + 1; 0: none. For a family: its first voxel, the node's own or
                                 ///< a child's

    [[nodiscard]] bool exists() const { return (children | voxel) != 0; }
    [[nodiscard]] bool hasFamily() const { return (children & familyFlag) != 0; }
    [[nodiscard]] bool hasVoxel() const { return hasFamily() ? (children & ownVoxelFlag) != 0 : voxel != 0; }
    /// Number of children in a family.
    [[nodiscard]] std::uint32_t familySize() const { return static_cast<std::uint32_t>(std::popcount(children & 255)); }
    /// The node of a family's child; empty if there is none.
    [[nodiscard]] NodeSlot familyChild(std::size_t octant) const {
        if ((children >> octant & 1) == 0) return {};
        const std::uint32_t before = children & ((1u << octant) - 1);
        return {0, voxel + (hasVoxel() ? 1 : 0) + static_cast<std::uint32_t>(std::popcount(before))};
    }
};

/// The children of one node by octant, 4·x + 2·y + z. Block 0 contains the root's children.
struct alignas(64) NodeBlock {
    std::array<NodeSlot, 8> slots;

    /// A child of a node whose children are in a block or a family.
    [[nodiscard]] static NodeSlot childOf(const NodeSlot& node, std::size_t octant, const NodeBlock* blocks) {
        return node.hasFamily() ? node.familyChild(octant) : blocks[node.children].slots[octant];
    }
};
static_assert(sizeof(NodeBlock) == 64);

}  // namespace dustbench::octree
