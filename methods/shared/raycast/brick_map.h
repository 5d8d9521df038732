// Which bricks of a grid's cells hold anything a sample in them could see.
//
// A brick is occupied where one of its cells, or of the cells around it as far as the filter reaches, has density.
// Units: cells. Owns its memory, booked on a ledger. Threads: set() spreads over them.
#pragma once

#include <cstdint>
#include <span>

#include "methods/shared/memory_ledger.h"
#include "methods/shared/raycast/shown_grid.h"

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
    [[nodiscard]] bool empty() const { return least_.x >= most_.x; }
    /// Cells [least, most) hold all occupied bricks.
    [[nodiscard]] glm::ivec3 least() const { return least_; }
    [[nodiscard]] glm::ivec3 most() const { return most_; }
    [[nodiscard]] float greatestDensity() const { return greatest_; }

 private:
    [[nodiscard]] std::size_t index(int x, int y, int z) const {
        return static_cast<std::size_t>(x + bricks_.x * (y + bricks_.y * z));
    }
    void findBounds(const glm::ivec3& cells);

    glm::ivec3 bricks_{0}, least_{0}, most_{0};
    float greatest_ = 0;
    LedgerVector<std::uint8_t> occupied_;
    LedgerVector<float> rowGreatest_;  ///< of each row of cells within each brick
};

}  // namespace dustbench::raycast
