// The depths of a relief in fixed point, for collision, ageing and drawing, and a pyramid of them.
//
//     D(u, v) = bilinear interpolation of the texels' depths, clamped at the rim
//
// Units: u and v in texels, texel (i, j) at (i, j), the face from −½ to columns − ½; depths as a share of the panel's
// depth, 0 at the face and 1 at the bottom, in steps of 2⁻³⁰. Integers make sums exact in any order.
// Owns: its columns and levels, booked on a ledger. Threads: any thread may read; one writer.
#pragma once

#include <algorithm>
#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "methods/contract/scene.h"
#include "methods/kit/memory/memory_ledger.h"

namespace dustbench::relief {

/// Texels [firstColumn, endColumn) × [firstRow, endRow).
struct TexelRectangle {
    int firstColumn = 0, firstRow = 0, endColumn = 0, endRow = 0;

    [[nodiscard]] int columns() const { return endColumn - firstColumn; }
    [[nodiscard]] int rows() const { return endRow - firstRow; }
    [[nodiscard]] bool empty() const { return firstColumn >= endColumn || firstRow >= endRow; }
};

/// The smallest that contains both.
[[nodiscard]] inline TexelRectangle joined(const TexelRectangle& a, const TexelRectangle& b) {
    if (a.empty()) return b;
    if (b.empty()) return a;
    return {std::min(a.firstColumn, b.firstColumn), std::min(a.firstRow, b.firstRow),
            std::max(a.endColumn, b.endColumn), std::max(a.endRow, b.endRow)};
}

class DepthMap {
 public:
    static constexpr std::uint32_t bottom = 1u << 30;

    DepthMap(const scene::Relief& relief, MemoryLedger& ledger);

    [[nodiscard]] int columns() const { return columns_; }
    [[nodiscard]] int rows() const { return rows_; }
    [[nodiscard]] std::size_t size() const { return depths_.size(); }
    [[nodiscard]] std::size_t texel(int column, int row) const {
        return static_cast<std::size_t>(row) * static_cast<std::size_t>(columns_) + static_cast<std::size_t>(column);
    }
    /// Row by row from the lowest, each at most `bottom`.
    [[nodiscard]] std::span<const std::uint32_t> depths() const { return depths_; }
    [[nodiscard]] std::span<std::uint32_t> depths() { return depths_; }

    /// Returns the depth of a texel; outside the map, that of the nearest texel.
    [[nodiscard]] double at(int column, int row) const;
    /// D(u, v).
    [[nodiscard]] double depthAt(double u, double v) const;
    /// (∂D/∂u, ∂D/∂v), within the patch that contains (u, v).
    [[nodiscard]] glm::dvec2 slopeAt(double u, double v) const;

 private:
    int columns_, rows_;
    LedgerVector<std::uint32_t> depths_;
};

/// A pyramid of the minimum depth in each block of a relief, so that a march can skip blocks without missing a hit.
///
/// Patch (i, j) lies between the texels (i − 1, j − 1) and (i, j), clamped at the rim: a relief of n texels has n + 1
/// patches a side. A block of level k holds 2ᵏ × 2ᵏ patches; the last level has one block. Levels are stored in
/// sequence.
class DepthPyramid {
 public:
    struct Level {
        std::size_t offset;  ///< of its first block
        int columns, rows;
    };

    DepthPyramid(const DepthMap& map, MemoryLedger& ledger);

    /// Updates the blocks over the changed texels.
    void update(const DepthMap& map, const TexelRectangle& changed);

    /// The blocks of a level over texels: as columns and rows of that level.
    [[nodiscard]] static TexelRectangle blocksOver(const TexelRectangle& texels, std::size_t level);

    /// Of the block of a level that holds a patch.
    [[nodiscard]] float nearestOver(int patchColumn, int patchRow, std::size_t level) const {
        const Level& own = levels_[level];
        return blocks_[own.offset +
                       static_cast<std::size_t>(patchRow >> level) * static_cast<std::size_t>(own.columns) +
                       static_cast<std::size_t>(patchColumn >> level)];
    }

    [[nodiscard]] std::span<const Level> levels() const { return levels_; }
    [[nodiscard]] std::span<const float> blocks() const { return blocks_; }

 private:
    void updateLevel(const Level& finer, const Level& level, const TexelRectangle& blocks);

    std::vector<Level> levels_;
    LedgerVector<float> blocks_;
};

}  // namespace dustbench::relief
