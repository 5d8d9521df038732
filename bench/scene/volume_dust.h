// Makes particles of a volume, so that methods that show puffs are held against it: one puff for each cell with
// density, with all of the cell's mass.
//
//     τ·2π·s² = σ·h³,   s = 0.7·h        h: edge of the cell, σ: its extinction
//
// Puffs so wide sum up to an even cloud within 2e-4 where the density is even; the picture differs from that of the
// volume by O(h²). The cell's place is the particle's id: between two moments its depth changes evenly, as the cell's
// density does; so each moment has also the cells that are filled in the moments beside it, with an opacity of 0.
// Units: m, s. Frame: world. Threads: pure.
#pragma once

#include <string>
#include <vector>

#include "bench/scene/dust_moment.h"
#include "methods/kit/volumes/volume_series.h"

namespace dustbench::bench {

/// s of a puff, by the edge of its cell (or of its block of cells).
inline constexpr double puffDeviationCells = 0.7;

/// Blocks of `setup.blockCells`³ cells count as one cell. Throws InputError, one line with the file, if a moment has
/// more particles than dust may have, or a cell more depth than a puff.
[[nodiscard]] std::vector<DustMoment> dustOfVolume(const volumes::VolumeSeries& series,
                                                   const volumes::VolumeSetup& setup);

}  // namespace dustbench::bench
