// How far a method's volume is from the reference's: ‖a − b‖ / ‖b‖ over the cells of two equal grids of extinction.
//
// Units: none. Frame: cells with x fastest, then y (up). Threads: pure.
#pragma once

#include <array>
#include <optional>
#include <span>

#include "bench/measure/image/plane.h"

namespace dustbench::bench {

struct GridCells {
    std::array<int, 3> cells{0, 0, 0};
    std::span<const float> extinctionPerMetre;
};

/// 0 or more, 0 for equal grids, 1 for an empty one against the reference. Empty where the reference holds nothing. The
/// map is seen from above, one pixel for each column of cells: √ Σ (a − b)² over the column, divided by ‖b‖, so that
/// value² = Σ map². Rows run along z, from its minimum.
/// Throws InputError for grids of different or wrong size, and for cells that are not finite.
[[nodiscard]] Measured volumeError(const GridCells& reference, const GridCells& grid);

}  // namespace dustbench::bench
