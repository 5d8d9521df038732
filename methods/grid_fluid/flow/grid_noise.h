// Noise at the grid's scale: the share of a quantity's variance along the vertical that lies in the top fifth of the
// spectrum.
//
// A stripe or speckle one or two cells wide is there; what a flow does at the scales that the grid resolves is not.
// Each column of cells is taken by itself, less its mean, under a Hann window; power is summed over all columns.
// Threads: columns in blocks, in the current arena; the same at any number of them.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <span>

namespace dustbench::grid_fluid::flow {

/// Of waves shorter than 2.5 cells, 0…1; 0 where nothing varies. `values`: one for each cell, x fastest. Columns with a
/// cell that is not 0 in `solids` are left out; it may be empty. Columns of fewer than 10 cells have no fifth of their
/// spectrum: 0.
[[nodiscard]] double gridNoise(std::span<const float> values, std::span<const std::uint8_t> solids,
                               const glm::ivec3& cells);

}  // namespace dustbench::grid_fluid::flow
