// The nodes of one brick: a cell that holds 16³ finest cells, and the four levels between.
//
// A cell of a brick is named by its location code: the Morton code inside the brick with a leading 1, which tells the
// level. 1 is the brick itself, 8..15 its children … 4096..8191 the finest cells; a cell's parent is code >> 3.
//
// Threads: pure.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>

#include "methods/shared/octree/node_block.h"

namespace dustbench::octree {

/// A brick lies so many levels above the finest cells.
inline constexpr int brickRise = 4;
inline constexpr std::uint32_t brickCodes = 8192;
inline constexpr int brickCodeBits = 13;

/// Location code of the cell that lies `rise` levels above a finest cell; that of the brick itself where `rise` leads
/// beyond it.
[[nodiscard]] inline std::uint32_t locationCode(std::uint32_t localCode, std::uint32_t rise) {
    return (4096u | localCode) >> 3 * std::min(rise, std::uint32_t{brickRise});
}
/// Levels that a location code's cell lies above the finest.
[[nodiscard]] inline int riseOf(std::uint32_t location) {
    return brickRise - (std::bit_width(location) - 1) / 3;
}

class BrickNodes {
 public:
    void clear() { voxels_.fill(0); }
    void setVoxel(std::uint32_t location) { voxels_[wordOf(location)] |= std::uint64_t{1} << (location & 63); }
    /// After the last voxel: counts what will be there.
    void complete();

    [[nodiscard]] std::uint32_t voxelCount() const { return voxelCount_; }
    /// Blocks of eight, the one of the brick's own children included.
    [[nodiscard]] std::uint32_t blockCount() const { return blockCount_; }
    /// Whether the brick as a whole is a voxel.
    [[nodiscard]] bool isVoxel() const { return isSet(1); }

    /// What `write` leaves for `rank`: by location code of all but the finest cells, that of the cell's voxel; and
    /// 1024 further, that of the first voxel in it.
    using Ranks = std::array<std::uint16_t, 2048>;
    /// Writes the brick's blocks: that of its own children to `first`, the others from `next` on. Voxels are numbered
    /// in pre-order: from `firstVoxel`.
    void write(NodeBlock* blocks, std::uint32_t first, std::uint32_t next, std::uint32_t firstVoxel,
               Ranks& ranks) const;
    /// Number of a voxel in pre-order, from 0. Without a branch, for levels come in any order.
    [[nodiscard]] std::uint32_t rank(std::uint32_t location, const Ranks& ranks) const {
        const std::uint64_t isFine = location >> 12;
        const std::uint64_t siblingsBefore = (isFine << (location & 63)) - (isFine << (location & 56));
        const int before = std::popcount(voxels_[wordOf(location)] & siblingsBefore);
        return ranks[location >> 3 * isFine | isFine << ranksBelowBit] + static_cast<std::uint32_t>(before);
    }

 private:
    struct Writer;
    // A bit for each cell: words of the location codes below 1024, then of those from 4096 on; between lie none.
    static constexpr std::uint32_t coarseWords = 16, fineWords = 64;
    static constexpr int ranksBelowBit = 10;
    static std::uint32_t wordOf(std::uint32_t location) { return (location >> 6) - (location >> 12) * 48; }

    [[nodiscard]] bool isSet(std::uint32_t location) const {
        return (voxels_[wordOf(location)] >> (location & 63) & 1) != 0;
    }
    std::array<std::uint64_t, coarseWords + fineWords> voxels_;
    std::array<std::uint64_t, coarseWords> nodes_;  ///< voxels, and cells that have one below them, once complete
    std::uint32_t voxelCount_ = 0, blockCount_ = 0;
};

}  // namespace dustbench::octree
