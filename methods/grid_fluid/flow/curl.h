// The curl of the flow at the centres of the cells, slab by slab. Internal to the forces.
//
// Speeds are first interpolated to the centres and split by component, so that differences run over plain rows.
// Units: metres per second, 1/s. Threads: slabs are independent. The caller owns the memory.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "methods/grid_fluid/flow/cell_field.h"

namespace dustbench::grid_fluid::flow {

class CurlField {
 public:
    /// Needs as much memory as a field of cells.
    static std::size_t floats(const CellLayout& layout) { return lanes * layout.padded(); }
    CurlField(const CellLayout& layout, std::span<float> memory);

    /// The speeds at the centres of slab k and of the ghosts around it; `cells` with ghosts.
    void findSpeeds(const CellField& cells, int k);
    /// ω by central differences of the speeds in slabs k − 1 to k + 1; 0 in solids.
    void findCurl(const std::uint8_t* conductance, float spacingMetres, int k);
    /// |ω|, in the memory of the speeds, which the curl of slabs k − 1 to k + 1 no longer needs.
    void findLength(int k);

    /// ω by axis, of all cells without ghosts, x fastest. Callers may overwrite it after reading.
    [[nodiscard]] const std::array<float*, 3>& curl() const { return curl_; }
    /// |ω| of a row's cells.
    [[nodiscard]] const float* length(int j, int k) const { return speeds_[0] + layout_.at(0, j, k); }
    /// Index in the arrays of the curl of the first cell of a row.
    [[nodiscard]] std::size_t row(int j, int k) const {
        return (static_cast<std::size_t>(k) * static_cast<std::size_t>(layout_.ny) + static_cast<std::size_t>(j)) *
               static_cast<std::size_t>(layout_.nx);
    }

 private:
    void findSpeedsOfRow(const CellField& cells, int j, int k);

    CellLayout layout_;
    std::array<float*, 3> speeds_;  ///< of padded cells, twice: the sums of the speeds of both faces
    std::array<float*, 3> curl_;
};

}  // namespace dustbench::grid_fluid::flow
