// Memory layout of the pressure: each row is split into its red and its black cells, as on a chess board.
//
// All neighbours of a red cell are black, so a sweep over one colour is a plain loop over whole vectors. Cell i of row
// (j, k) has colour (i + j + k) mod 2 and index i/2 in its half.
#pragma once

#include <cstddef>
#include <glm/glm.hpp>
#include <span>

namespace dustbench::grid_fluid::flow {

struct SplitLayout {
    explicit SplitLayout(glm::ivec3 cells)
        : nx(cells.x),
          ny(cells.y),
          nz(cells.z),
          half((static_cast<std::size_t>(nx) + 1) / 2),
          row((half + 16) / 16 * 16),
          slab(row * (static_cast<std::size_t>(ny) + 2)) {}

    /// First cell of a row, −1 ≤ j ≤ ny, −1 ≤ k ≤ nz. There is at least one entry between two rows, for the ghosts.
    [[nodiscard]] std::size_t at(int j, int k) const {
        return front + static_cast<std::size_t>(k + 1) * slab + static_cast<std::size_t>(j + 1) * row;
    }
    [[nodiscard]] std::size_t size() const { return front + slab * (static_cast<std::size_t>(nz) + 2); }
    [[nodiscard]] std::size_t rows() const { return static_cast<std::size_t>(ny) * static_cast<std::size_t>(nz); }
    [[nodiscard]] int rowJ(std::size_t r) const { return static_cast<int>(r % static_cast<std::size_t>(ny)); }
    [[nodiscard]] int rowK(std::size_t r) const { return static_cast<int>(r / static_cast<std::size_t>(ny)); }
    [[nodiscard]] std::size_t cells() const { return rows() * static_cast<std::size_t>(nx); }
    /// Number of rows in a block of work that is worth a thread.
    [[nodiscard]] std::size_t rowsInABlock() const { return (std::size_t{4096} + half * 2 - 1) / (half * 2); }

    static constexpr std::size_t front = 16;
    int nx, ny, nz;
    std::size_t half, row, slab;
};

/// One value for each cell, in its two halves.
struct SplitField {
    float* colour[2];

    /// Cell i of row (j, k), ghosts included. For code where speed does not matter.
    [[nodiscard]] float& cell(const SplitLayout& layout, int i, int j, int k) const {
        return colour[(i + j + k) & 1][static_cast<std::ptrdiff_t>(layout.at(j, k)) + (i >> 1)];
    }
};

/// Allocates parts of borrowed memory; without memory it only counts.
class Arena {
 public:
    Arena() = default;
    explicit Arena(std::span<float> memory) : memory_(memory) {}

    [[nodiscard]] float* take(std::size_t floats) {
        const std::size_t at = used_;
        used_ += (floats + 15) / 16 * 16;
        return memory_.empty() ? nullptr : memory_.subspan(at, floats).data();
    }
    [[nodiscard]] SplitField takeField(const SplitLayout& layout) {
        return {{take(layout.size()), take(layout.size())}};
    }
    [[nodiscard]] std::size_t used() const { return used_; }

 private:
    std::span<float> memory_;
    std::size_t used_ = 0;
};

}  // namespace dustbench::grid_fluid::flow
