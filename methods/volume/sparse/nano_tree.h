// A sparse grid of floats in NanoVDB's memory layout; cells without a leaf are 0.
//
// A cell is active if a sample between its centre and those of its upper neighbours may see density: if it or one of
// its seven upper neighbours has some. A leaf holds 8×8×8 cells, at least one of which has density. A brick with active
// cells but without density is an active tile of 0. Both marches visit only leaves and tiles.
//
// Units: cells of the lattice of a series; metres where stated. Owns: the grid, booked on a ledger. Threads: const
// members are safe from any. Source: Museth2021.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "methods/kit/memory/memory_ledger.h"
#include "methods/volume/sparse/bricks.h"

namespace dustbench::volume {

/// 512 cells, z fastest: a word for each x.
using CellMask = std::array<std::uint64_t, brickEdge>;

/// A brick of a tree: a leaf, or a tile if it has no values.
struct TreeBrick {
    glm::ivec3 at{0};
    bool isLeaf = false;
    CellMask active{};
    std::size_t source = 0;  ///< an identifier chosen by the builder of the tree
};

class NanoTree {
 public:
    explicit NanoTree(MemoryAccount& account) : bytes_(account), leaves_(account), tiles_(account) {}

    /// Lays out these bricks, which must be distinct, and sorts them in the order of the tree. All values are 0.
    /// `spacingMetres` and `originMetres`, the minimum corner of cell (0, 0, 0), are for other programs.
    /// Throws InputError if the tree takes more than `maximumBytes`.
    void lay(std::vector<TreeBrick>& bricks, double spacingMetres, const glm::dvec3& originMetres,
             std::size_t maximumBytes);
    /// The values of leaf number `leaf` in the order of lay().
    [[nodiscard]] float* valuesOf(std::size_t leaf);
    [[nodiscard]] const float* valuesOf(std::size_t leaf) const;
    [[nodiscard]] const glm::ivec3& brickOf(std::size_t leaf) const { return leaves_[leaf]; }
    [[nodiscard]] std::size_t leafCount() const { return leaves_.size(); }

    /// All bricks, in the order of lay(); tiles as if all of their cells were active.
    [[nodiscard]] std::vector<TreeBrick> bricks() const;

    [[nodiscard]] bool empty() const { return bytes_.empty() || leaves_.empty(); }
    /// The grid as a NanoVDB buffer.
    [[nodiscard]] std::span<const std::byte> bytes() const { return bytes_; }
    /// The range [minimum, maximum) contains all active cells.
    [[nodiscard]] const glm::ivec3& minimum() const { return minimum_; }
    [[nodiscard]] const glm::ivec3& maximum() const { return maximum_; }
    /// The sum of all values.
    [[nodiscard]] double sum() const;

 private:
    LedgerVector<std::byte> bytes_;
    LedgerVector<glm::ivec3> leaves_, tiles_;  ///< their bricks
    std::size_t leafOffset_ = 0;
    glm::ivec3 minimum_{0}, maximum_{0};
};

}  // namespace dustbench::volume
