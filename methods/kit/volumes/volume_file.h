// Reads the density of one file, `.vti`, `.vdb` or `.nvdb`, which may be any program's.
#pragma once

#include <filesystem>

#include "methods/kit/volumes/volume_grid.h"
#include "methods/kit/volumes/volume_setup.h"
#include "methods/kit/volumes/volume_sink.h"

namespace dustbench::volumes {

/// `.vti`: data of its cells or of its points, wherever the density is; points are the middles of cells (vti_fields.h);
/// time from the field data `TimeValue`. `.vdb`: grids of numbers, time from the metadata `time_s`; a level set becomes
/// fog. `.nvdb`: the same without time. A density between 0 and −1e-3 of the maximum counts as 0. Throws InputError
/// with the file and what is wrong, in one line.
[[nodiscard]] DUSTBENCH_API VolumeGrid readVolume(const std::filesystem::path& file, const VolumeFields& fields);

/// The same number by number, to a sink that checks them itself. Also throws what the sink throws.
DUSTBENCH_API void streamVolume(const std::filesystem::path& file, const VolumeFields& fields, VolumeSink& sink);

/// What a density may be, of which `maximum` is the highest: 0 or more. Throws InputError for another `density`.
DUSTBENCH_API void requireDensity(float density, float maximum, const std::filesystem::path& file, bool clampsDensity);

}  // namespace dustbench::volumes
