// The octree of one frame: nodes for traversal, and its voxels in a fixed order.
//
// Units: metres. Frame: world. Owns: nodes and voxels, booked on a ledger and kept between frames. Threads: any thread
// may call const members.
// Source: Carr2006, 3.2 and Fig. 3.
#pragma once

#include <bit>
#include <cstdint>
#include <span>

#include "methods/kit/octree/cell_entry.h"
#include "methods/kit/octree/lattice.h"
#include "methods/kit/octree/node_block.h"
#include "methods/kit/octree/reused_array.h"

namespace dustbench::octree {

class Octree {
 public:
    explicit Octree(MemoryLedger& ledger)
        : blocks_(ledger.account("octree nodes")),
          voxels_(ledger.account("octree voxels")),
          masses_(ledger.account("octree voxels")) {}

    /// A position in the tree. Cheap to copy; valid until the tree is rebuilt.
    class Cursor {
     public:
        [[nodiscard]] int level() const { return level_; }
        /// Morton code of the first finest cell inside.
        [[nodiscard]] std::uint64_t code() const { return code_; }
        [[nodiscard]] bool hasVoxel() const { return slot_.hasVoxel(); }
        /// Index into `voxels()`.
        [[nodiscard]] std::uint32_t voxel() const { return slot_.voxel - 1; }
        [[nodiscard]] bool hasChildren() const { return level_ == 0 || slot_.children != 0; }
        /// True if the octant has a node, which `child` requires.
        [[nodiscard]] bool hasChild(unsigned octant) const { return hasChildren() && slotOf(octant).exists(); }
        [[nodiscard]] Cursor child(unsigned octant) const {
            const std::uint64_t below = static_cast<std::uint64_t>(octant) << 3 * (tree_->depth_ - level_ - 1);
            return {*tree_, slotOf(octant), level_ + 1, code_ | below};
        }

     private:
        friend class Octree;
        Cursor(const Octree& tree, NodeSlot slot, int level, std::uint64_t code)
            : tree_(&tree), slot_(slot), level_(level), code_(code) {}
        [[nodiscard]] NodeSlot slotOf(unsigned octant) const {
            return NodeBlock::childOf(slot_, octant, tree_->blocks_.data());
        }

        const Octree* tree_;
        NodeSlot slot_;
        int level_;
        std::uint64_t code_;
    };

    [[nodiscard]] Cursor root() const { return {*this, NodeSlot{}, 0, 0}; }

    /// In pre-order. Each refers to the particle that represents it.
    [[nodiscard]] std::span<const CellEntry> voxels() const { return {voxels_.data(), voxelCount_}; }
    /// Optical mass of each voxel, m²; empty unless the policy is `accumulate`.
    [[nodiscard]] std::span<const double> masses() const { return {masses_.data(), massCount_}; }
    /// Block 0 contains the root's children.
    [[nodiscard]] std::span<const NodeBlock> blocks() const { return {blocks_.data(), blockCount_}; }
    [[nodiscard]] int depth() const { return depth_; }
    /// Of nodes and voxels, without reserved memory.
    [[nodiscard]] std::size_t bytes() const {
        return blocks().size_bytes() + voxels().size_bytes() + masses().size_bytes();
    }

    // For builders.

    /// Resets to an empty tree: a root without children.
    void clear(int depth) {
        depth_ = depth;
        voxelCount_ = massCount_ = 0;
        blocks_.extend(1, 0)[0] = NodeBlock{};
        blockCount_ = 1;
    }
    /// Adds an empty block. May relocate all blocks.
    std::uint32_t addBlock() {
        blocks_.extend(blockCount_ + 1, blockCount_)[blockCount_] = NodeBlock{};
        return static_cast<std::uint32_t>(blockCount_++);
    }
    /// Returns the node `rise` levels above the finest that contains the finest cell `code`, and adds missing nodes on
    /// its path. Not allowed below a family (node_block.h). May relocate all blocks.
    NodeSlot& makeNode(std::uint64_t code, int rise) {
        std::uint32_t block = 0;
        int shift = 3 * (depth_ - 1);
        for (; shift > 3 * rise; shift -= 3) {
            const std::size_t octant = code >> shift & 7;
            std::uint32_t next = blocks_.data()[block].slots[octant].children;
            if (next == 0) {
                next = addBlock();
                blocks_.data()[block].slots[octant].children = next;
            }
            block = next;
        }
        return blocks_.data()[block].slots[code >> shift & 7];
    }
    /// Sets the number of blocks to `count`; keeps the first one, the builder must write the others.
    void setBlocks(std::size_t count) {
        blocks_.extend(count, 1);
        blockCount_ = count;
    }
    /// Sets the number of voxels to `count`. The builder must write new voxels; existing ones keep their values unless
    /// the memory is reallocated.
    void setVoxels(std::size_t count, bool withMasses) {
        voxels_.hold(count);
        voxelCount_ = count;
        massCount_ = withMasses ? count : 0;
        masses_.hold(massCount_);
    }
    [[nodiscard]] NodeBlock* mutableBlocks() { return blocks_.data(); }
    [[nodiscard]] CellEntry* mutableVoxels() { return voxels_.data(); }
    [[nodiscard]] double* mutableMasses() { return masses_.data(); }

 private:
    ReusedArray<NodeBlock> blocks_;
    ReusedArray<CellEntry> voxels_;
    ReusedArray<double> masses_;
    std::size_t blockCount_ = 0, voxelCount_ = 0, massCount_ = 0;
    int depth_ = minimumDepth;
};

}  // namespace dustbench::octree
