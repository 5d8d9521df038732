// The nodes of one brick: a cell of 16³ finest cells, and the four levels below it.
//
// Outside this class a cell of a brick is identified by its place: its number in pre-order among all cells of the
// brick, from 1. Nodes use its location code: the Morton code inside the brick with a leading 1, which encodes the
// level. 1 is the brick itself, 8..15 its children … 4096..8191 the finest cells; a cell's parent is code >> 3.
//
// Threads: pure.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>

#include "methods/kit/octree/octree.h"

namespace dustbench::octree {

/// Levels between a brick and the finest cells.
inline constexpr int brickRise = 4;
/// Number of finest cells, and of places for the cells of all levels including the brick. Place 0 is unused.
inline constexpr std::uint32_t finestInBrick = 4096, placesInBrick = 4682;
inline constexpr int brickPlaceBits = 13;

/// Place of the cell `rise` levels above a finest cell; the brick itself if `rise` leads beyond it. Octant o of a cell
/// comes 1 + 585·o, 1 + 73·o, 1 + 9·o or 1 + o places after that cell, by level; 585 = 512 + 64 + 8 + 1.
[[nodiscard]] constexpr std::uint32_t placeInBrick(std::uint32_t localCode, std::uint32_t rise) {
    const std::uint32_t up = std::min(rise, std::uint32_t{brickRise});
    const std::uint32_t code = localCode >> 3 * up << 3 * up;
    return code + (code >> 3) + (code >> 6) + (code >> 9) + 1 + brickRise - up;
}

/// For each place, the entry's bits of a voxel there: 12 bits of its code, 4 bits of its rise.
inline constexpr std::array<std::uint16_t, placesInBrick> codeAndRiseOfPlace = [] {
    std::array<std::uint16_t, placesInBrick> cells{};
    for (std::uint32_t rise = 0; rise <= brickRise; ++rise)
        for (std::uint32_t code = 0; code < finestInBrick; code += 1u << 3 * rise)
            cells[placeInBrick(code, rise)] = static_cast<std::uint16_t>(code << 4 | rise);
    return cells;
}();

/// One bit for each place of a brick.
using PlaceBits = std::array<std::uint64_t, (placesInBrick + 63) / 64>;

class DUSTBENCH_API BrickNodes {
 public:
    /// Sets the nodes from the places that have a voxel.
    void set(const PlaceBits& voxels);

    [[nodiscard]] std::uint32_t voxelCount() const { return voxelCount_; }
    /// Number of blocks of eight, including that of the brick's own children.
    [[nodiscard]] std::uint32_t blockCount() const { return blockCount_; }
    /// True if the whole brick is one voxel.
    [[nodiscard]] bool isVoxel() const { return (voxels_[0] & 2) != 0; }

    /// Writes the brick's blocks: its own children's to `first`, the others from `next` on. Voxels are numbered in
    /// pre-order from `firstVoxel`.
    void write(NodeBlock* blocks, std::uint32_t first, std::uint32_t next, std::uint32_t firstVoxel) const;

 private:
    struct Writer;

    void sortByLevel(const PlaceBits& voxels);
    void findNodes();

    // One bit per cell: words of the coarse cells, then of the finest.
    static constexpr std::uint32_t coarseWords = 16, fineWords = 64;

    std::array<std::uint64_t, coarseWords + fineWords> voxels_;
    std::array<std::uint64_t, coarseWords> nodes_;  ///< cells that have or contain a voxel
    std::uint32_t voxelCount_ = 0, blockCount_ = 0;
};

}  // namespace dustbench::octree
