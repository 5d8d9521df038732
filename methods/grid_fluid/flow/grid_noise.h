// Noise at the grid's scale: the share of a quantity's variance along the vertical that lies in the top fifth of the
// spectrum.
//
// Stripes and speckle one or two cells wide are in this range; flow at scales that the grid resolves is not. Each
// column of cells is processed separately, minus its mean, under a Hann window; power is summed over all columns.
// Threads: columns in blocks, in the current arena; results do not depend on their number.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <span>

namespace dustbench::grid_fluid::flow {

/// The share of waves shorter than 2.5 cells, 0…1; 0 if nothing varies. `values`: one for each cell, x fastest. Columns
/// with a cell that is not 0 in `solids` are omitted; `solids` may be empty. Returns 0 for columns of fewer than 10
/// cells, since their spectrum cannot be divided into fifths.
[[nodiscard]] double gridNoise(std::span<const float> values, std::span<const std::uint8_t> solids,
                               const glm::ivec3& cells);

}  // namespace dustbench::grid_fluid::flow
