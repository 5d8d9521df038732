// A grid's cells surrounded by copies of the outermost ones, so that samples near its faces need no special case.
//
// Units: cells; node (0, 0, 0) is the centre of the first cell. Owns: its memory, booked on a ledger.
#pragma once

#include <cstddef>
#include <glm/glm.hpp>
#include <span>

#include "methods/kit/memory/memory_ledger.h"

namespace dustbench::raycast {

class PaddedCells {
 public:
    /// Layers before the first and behind the last cell, as far as a window that starts in any cell can reach.
    static constexpr int before = 1, behind = 3;

    explicit PaddedCells(MemoryAccount& account) : values_(account) {}

    void set(const glm::ivec3& cells, std::span<const float> values);

    [[nodiscard]] const glm::ivec3& cells() const { return cells_; }
    /// Stride from one row, or slab, to the next.
    [[nodiscard]] int row() const { return cells_.x + before + behind; }
    [[nodiscard]] int slab() const { return row() * (cells_.y + before + behind); }
    /// Node (0, 0, 0); nodes from −1 to cells + 2 may be read.
    [[nodiscard]] const float* origin() const { return values_.data() + before * (1 + row() + slab()); }

 private:
    glm::ivec3 cells_{0};
    LedgerVector<float> values_;
};

}  // namespace dustbench::raycast
