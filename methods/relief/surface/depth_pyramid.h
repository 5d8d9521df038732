// A pyramid of the minimum depth in each block of a relief, so that a march can skip blocks without missing a hit.
//
// Patch (i, j) lies between the texels (i − 1, j − 1) and (i, j), clamped at the rim: a relief of n texels has n + 1
// patches a side. A block of level k holds 2ᵏ × 2ᵏ patches; the last level has one block.
//
// Units: shares of the depth. Owns: its levels, stored in sequence, booked on a ledger. Threads: one writer.
#pragma once

#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "methods/relief/surface/worn_surface.h"

namespace dustbench::relief {

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
