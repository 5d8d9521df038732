// Distance between a method's volume and the reference's: ‖a − b‖ / ‖b‖ over the cells of two equal grids of
// extinction.
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

/// 0 or more: 0 for equal grids, 1 for an empty grid against the reference. Empty if the reference is empty. The map is
/// the view from above, one pixel per column of cells: √ Σ (a − b)² over the column, divided by ‖b‖, so that value² = Σ
/// map². Rows run along z, from its minimum.
/// Throws InputError for grids of different or wrong size, and for cells that are not finite.
[[nodiscard]] Measured volumeError(const GridCells& reference, const GridCells& grid);

}  // namespace dustbench::bench
