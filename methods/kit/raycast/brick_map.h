// Which bricks of a grid's cells hold anything a sample in them could see.
//
// A brick is occupied where one of its cells, or of the cells around it as far as the filter reaches, has density.
// Units: cells. Owns its memory, booked on a ledger. Threads: set() spreads over them.
#pragma once

#include <cstdint>
#include <span>

#include "methods/kit/memory/memory_ledger.h"
#include "methods/kit/raycast/shown_grid.h"

namespace dustbench::raycast {

class BrickMap {
 public:
    static constexpr int edge = 4;

    explicit BrickMap(MemoryLedger& ledger);

    /// `reach`: cells that a sample sees beyond its own. Throws InputError for a density that is negative or not a
    /// number.
    void set(const ShownGrid& grid, int reach);

    [[nodiscard]] glm::ivec3 bricks() const { return bricks_; }
    /// 255 or 0 by brick, x fastest.
    [[nodiscard]] std::span<const std::uint8_t> occupied() const { return occupied_; }
    [[nodiscard]] bool at(int x, int y, int z) const { return occupied_[index(x, y, z)] != 0; }
    [[nodiscard]] bool empty() const { return minimum_.x >= maximum_.x; }
    /// Cells [minimum, most) hold all occupied bricks.
    [[nodiscard]] glm::ivec3 minimum() const { return minimum_; }
    [[nodiscard]] glm::ivec3 maximum() const { return maximum_; }

 private:
    [[nodiscard]] std::size_t index(int x, int y, int z) const {
        return static_cast<std::size_t>(x + bricks_.x * (y + bricks_.y * z));
    }
    void findBounds(const glm::ivec3& cells);

    glm::ivec3 bricks_{0}, minimum_{0}, maximum_{0};
    LedgerVector<std::uint8_t> occupied_;
    LedgerVector<float> rowMaximum_;  ///< of each row of cells within each brick
};

}  // namespace dustbench::raycast
