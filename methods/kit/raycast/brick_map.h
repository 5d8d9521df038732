// Finds the bricks of a grid in which a sample could have density.
//
// A brick is occupied if one of its cells, or of the surrounding cells within the filter's reach, has density.
// Units: cells. Owns: its memory, booked on a ledger. Threads: set() runs in parallel.
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

    /// `reach`: number of cells that a sample reads beyond its own. Throws InputError if a density is negative or NaN.
    void set(const ShownGrid& grid, int reach);

    [[nodiscard]] glm::ivec3 bricks() const { return bricks_; }
    /// 255 or 0 per brick, x fastest.
    [[nodiscard]] std::span<const std::uint8_t> occupied() const { return occupied_; }
    [[nodiscard]] bool at(int x, int y, int z) const { return occupied_[index(x, y, z)] != 0; }
    [[nodiscard]] bool empty() const { return minimum_.x >= maximum_.x; }
    /// The range [minimum, maximum) of cells contains all occupied bricks.
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
