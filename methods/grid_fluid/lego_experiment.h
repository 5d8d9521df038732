// Measures the look of building bricks that a grid's cells have in a picture, and what treats it (claim R30).
//
// A cloud of Gaussians, whose picture is known exactly, is held in a grid as averages of its cells and ray cast from so
// far away that the borders of cells lie between columns and rows of pixels. Blocks show as jumps there: the change of
// the picture from one side of a border to the other, less the exact picture's. The measure is the root mean square of
// that over the exact picture's own changes at the same borders: 0 for the exact picture; 1 where a border adds as much
// as the cloud itself changes.
//
// Units: metres. Threads: that of the device. Source: Senger2009, 3.1 and 4.3.2.
#pragma once

#include <cstdint>

#include "methods/contract/experiment.h"
#include "methods/kit/gpu/device.h"
#include "methods/kit/pictures/image.h"
#include "methods/kit/raycast/raycast_settings.h"

namespace dustbench::grid_fluid::lego {

inline constexpr int pixelsPerCell = 8;

/// The measure, of alphas. Both pictures have a border of cells after each `pixelsPerCell` columns and rows.
[[nodiscard]] double blocksOf(const pictures::Image& picture, const pictures::Image& exact);

/// The same of a cloud drawn by `seed` in a grid of `cells` × 2 `cells` × `cells`.
[[nodiscard]] double blocksSeen(gpu::Device& device, const raycast::RaycastSettings& settings, int cells,
                                std::uint64_t seed);

/// The experiment `lego`. BACKEND: gl, cpu; geometric means over clouds drawn by the seed, at half a cell a step
/// without jitter unless said otherwise:
///     blocks_FILTER_BACKEND    FILTER: nearest, linear, cubic
///     FILTER_BACKEND           the same over that of nearest
///     jitter_BACKEND           nearest with jitter, over nearest
///     finer_BACKEND            nearest at a sixteenth of a cell a step, over nearest
///     coarser_BACKEND          nearest at a cell a step, over nearest
[[nodiscard]] ExperimentInfo describe();

}  // namespace dustbench::grid_fluid::lego
