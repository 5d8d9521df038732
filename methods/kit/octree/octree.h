// The octree of one frame: nodes for traversal, and its voxels in a fixed order; and the interface of its builders.
//
// Units: metres. Frame: world. Owns: nodes and voxels, booked on a ledger and kept between frames. Threads: any thread
// may call const members.
// Source: Carr2006, 3.2 and Fig. 3.
#pragma once

#include <array>
#include <bit>
#include <cstdint>
#include <span>

#include "methods/contract/volume.h"
#include "methods/kit/memory/memory_ledger.h"
#include "methods/kit/octree/lattice.h"
#include "methods/kit/octree/octree_settings.h"

namespace dustbench::octree {

/// Packs a particle's cell in the tree, or a voxel, into one word.
///
/// From the top: 36 bits Morton code of a finest cell, 4 bits rise (levels above the finest), 24 bits particle index. A
/// voxel's code is that of the first finest cell inside it, so that pre-order of voxels is the order of (code,
/// descending rise).
class CellEntry {
 public:
    static constexpr std::uint32_t maximumIndex = (1u << 24) - 1;

    CellEntry() = default;
    explicit CellEntry(std::uint64_t word) : word_(word) {}
    CellEntry(std::uint64_t code, int rise, std::uint32_t index)
        : word_(code << 28 | static_cast<std::uint64_t>(rise) << 24 | index) {}

    [[nodiscard]] std::uint64_t code() const { return word_ >> 28; }
    [[nodiscard]] int rise() const { return static_cast<int>(word_ >> 24 & 0xf); }
    [[nodiscard]] std::uint32_t index() const { return static_cast<std::uint32_t>(word_ & maximumIndex); }
    [[nodiscard]] std::uint64_t word() const { return word_; }
    /// Code of the voxel that contains the particle.
    [[nodiscard]] std::uint64_t voxelCode() const { return code() >> 3 * rise() << 3 * rise(); }
    /// Identifies the voxel: equal for all of its particles, and ascending in pre-order.
    [[nodiscard]] std::uint64_t place() const { return voxelCode() << 4 | static_cast<std::uint64_t>(15 - rise()); }
    bool operator==(const CellEntry&) const = default;

 private:
    std::uint64_t word_;
};

// --- Nodes in memory: the eight children of a node are contiguous in one cache line; finest cells need no nodes

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

/// An array that keeps its memory between frames and grows on demand. Owns: its elements, booked on a ledger. Growth
/// reserves extra capacity, so that a steady load does not allocate.
template <typename T>
class ReusedArray {
 public:
    explicit ReusedArray(MemoryAccount& account) : memory_(account) {}

    /// Space for `count` elements of unspecified value; growth discards the old contents.
    T* hold(std::size_t count) {
        if (memory_.size() < count) {
            const std::size_t size = count + count / 8;
            memory_.clear();
            memory_.shrink_to_fit();
            memory_.resize(size);
        }
        return memory_.data();
    }
    /// Space for `count` elements; keeps the first `used`.
    T* extend(std::size_t count, std::size_t used) {
        if (memory_.size() < count) {
            memory_.resize(used);
            memory_.resize(count + count / 2);
        }
        return memory_.data();
    }
    [[nodiscard]] T* data() { return memory_.data(); }
    [[nodiscard]] const T* data() const { return memory_.data(); }
    [[nodiscard]] std::size_t size() const { return memory_.size(); }

 private:
    LedgerVector<T> memory_;
};

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
    /// its path. Not allowed below a family (NodeSlot). May relocate all blocks.
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

/// All builders return the same voxels in the same order.
class DUSTBENCH_API OctreeBuilder {
 public:
    virtual ~OctreeBuilder();
    /// Returns the number of particles outside the world, which belong to no voxel. Throws SimulationError if a
    /// position is NaN.
    virtual std::int64_t build(const Puffs& store, const Lattice& lattice, const OctreeSettings& settings,
                               Octree& tree) = 0;
    /// Bytes of the structure with the voxels of `tree`, the last one built, without temporary memory of the build.
    [[nodiscard]] virtual std::size_t structureBytes(const Octree& tree) const { return tree.bytes(); }
};

}  // namespace dustbench::octree
