// Converts a volume to particles, so that it can be compared with methods that draw puffs: one puff for each cell with
// density, with all of the cell's mass.
//
//     τ·2π·s² = σ·h³,   s = 0.7·h        h: edge of the cell, σ: its extinction
//
// At this width, puffs add up to uniform density within 2e-4 where the density is uniform; the picture differs from
// that of the volume by O(h²). The cell's index is the particle's id: between two moments its depth changes linearly,
// like the cell's density. Each moment therefore also contains the cells that are filled in the previous or next
// moment, with an opacity of 0.
// Units: m, s. Frame: world. Threads: pure.
#pragma once

#include <string>
#include <vector>

#include "bench/scene/dust_moment.h"
#include "methods/kit/volumes/volume_series.h"

namespace dustbench::bench {

/// s of a puff in units of the edge of its cell or block of cells.
inline constexpr double puffDeviationCells = 0.7;

/// Blocks of `setup.blockCells`³ cells count as one cell. Throws InputError, one line with the file, if a moment has
/// more particles than allowed for dust, or a cell more depth than allowed for a puff.
[[nodiscard]] std::vector<DustMoment> dustOfVolume(const volumes::VolumeSeries& series,
                                                   const volumes::VolumeSetup& setup);

}  // namespace dustbench::bench
