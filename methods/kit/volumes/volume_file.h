// Reads the density of one file, `.vti`, `.vdb` or `.nvdb`, which may be any program's.
#pragma once

#include <filesystem>

#include "methods/kit/volumes/volume_grid.h"
#include "methods/kit/volumes/volume_setup.h"

namespace dustbench::volumes {

/// `.vti`: data of its cells or, if it has none, of its points, which then are the middles of cells; time from the
/// field data `TimeValue`. `.vdb`: grids of numbers, time from the metadata `time_s`; a level set becomes fog. `.nvdb`:
/// the same without time. A density between 0 and −1e-3 of the maximum counts as 0. Throws InputError with the file
/// and what is wrong, in one line.
[[nodiscard]] DUSTBENCH_API VolumeGrid readVolume(const std::filesystem::path& file, const VolumeFields& fields);

}  // namespace dustbench::volumes
