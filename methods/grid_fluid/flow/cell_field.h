// The state of a fluid: one record of six floats per cell, so that one sample reads all transported quantities.
//
// The speeds are those of the air through the cell's faces towards −x, −y and −z; all other quantities are at the
// cell's centre. A layer of ghost cells around the box represents the outside of its sides; those beyond the far sides
// hold the faces there. Cell indices run from −1 to n. Units: metres per second, kelvin above the air. Owns its memory,
// booked on a ledger.
#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>

#include "methods/kit/memory/memory_ledger.h"

namespace dustbench::grid_fluid::flow {

/// The quantities of a cell, by index in its record.
enum Lane : std::uint8_t { velocityX, velocityY, velocityZ, density, temperature, reaction };
inline constexpr std::size_t lanes = 6;

/// Memory layout of cells: x runs fastest, with one ghost cell at either end of each axis.
struct CellLayout {
    explicit CellLayout(glm::ivec3 cells)
        : nx(cells.x),
          ny(cells.y),
          nz(cells.z),
          row(static_cast<std::size_t>(nx) + 2),
          slab(row * (static_cast<std::size_t>(ny) + 2)) {}

    [[nodiscard]] std::size_t at(int i, int j, int k) const {
        return static_cast<std::size_t>(k + 1) * slab + static_cast<std::size_t>(j + 1) * row +
               static_cast<std::size_t>(i + 1);
    }
    [[nodiscard]] std::size_t padded() const { return slab * (static_cast<std::size_t>(nz) + 2); }
    [[nodiscard]] std::size_t rows() const { return static_cast<std::size_t>(ny) * static_cast<std::size_t>(nz); }
    [[nodiscard]] int rowJ(std::size_t r) const { return static_cast<int>(r % static_cast<std::size_t>(ny)); }
    [[nodiscard]] int rowK(std::size_t r) const { return static_cast<int>(r / static_cast<std::size_t>(ny)); }

    int nx, ny, nz;
    std::size_t row, slab;  ///< stride of a row and of a slab, in cells
};

/// Records of all cells. Kernels read sixteen at once, so the memory is padded behind the last.
class CellField {
 public:
    static constexpr std::size_t floatsBehind = 16 * lanes;

    CellField(const CellLayout& layout, MemoryAccount& account, std::size_t minimumFloats = 0) : values_(account) {
        values_.resize(std::max(layout.padded() * lanes + floatsBehind, minimumFloats));
    }
    [[nodiscard]] float* data() { return values_.data(); }
    [[nodiscard]] const float* data() const { return values_.data(); }
    [[nodiscard]] float* cell(std::size_t at) { return values_.data() + at * lanes; }
    [[nodiscard]] const float* cell(std::size_t at) const { return values_.data() + at * lanes; }
    [[nodiscard]] std::size_t floats() const { return values_.size(); }
    void swap(CellField& other) { values_.swap(other.values_); }

 private:
    LedgerVector<float> values_;
};

}  // namespace dustbench::grid_fluid::flow
