// Measures how much a grid's cells look like building bricks in a picture, and the effect of remedies (claim R30).
//
// A cloud of Gaussians, whose picture is known exactly, is stored in a grid as averages over its cells. It is ray cast
// from so far away that the borders of cells lie between columns and rows of pixels. Blocks show as jumps there: the
// change of the picture across a border, minus that of the ground truth. The measure is the root mean square of these,
// divided by that of the ground truth's changes at the same borders: 0 for the ground truth, 1 if a border adds as much
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

/// The measure for alphas. Both pictures have a border of cells after every `pixelsPerCell` columns and rows.
[[nodiscard]] double blocksOf(const pictures::Image& picture, const pictures::Image& exact);

/// The same for a cloud drawn by `seed` in a grid of `cells` × 2 `cells` × `cells`.
[[nodiscard]] double blocksSeen(gpu::Device& device, const raycast::RaycastSettings& settings, int cells,
                                std::uint64_t seed);

/// The experiment `lego`. BACKEND: gl, cpu; geometric means over clouds drawn by the seed, with steps of half a cell
/// without jitter unless stated otherwise:
///     blocks_FILTER_BACKEND    FILTER: nearest, linear, cubic
///     FILTER_BACKEND           the same divided by that of nearest
///     jitter_BACKEND           nearest with jitter, divided by nearest
///     finer_BACKEND            nearest with steps of a sixteenth of a cell, divided by nearest
///     coarser_BACKEND          nearest with steps of a cell, divided by nearest
[[nodiscard]] ExperimentInfo describe();

}  // namespace dustbench::grid_fluid::lego
