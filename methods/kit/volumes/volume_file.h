// Reads the density of one file, `.vti`, `.vdb` or `.nvdb`, from any program, or its field of vectors.
#pragma once

#include <filesystem>
#include <string>

#include "methods/kit/volumes/grid_place.h"
#include "methods/kit/volumes/volume_setup.h"

namespace dustbench::volumes {

/// `.vti`: data of its cells or its points, whichever contain the density; points are the centres of cells
/// (vti_fields.h); time from the field data `TimeValue`. `.vdb`: grids of numbers, time from the metadata `time_s`; a
/// level set becomes fog. `.nvdb`: the same without time. A density between 0 and −1e-3 of the maximum counts as 0.
/// Throws InputError with the file and the fault in one line.
[[nodiscard]] DUSTBENCH_API VolumeGrid readVolume(const std::filesystem::path& file, const VolumeFields& fields);

/// The same value by value, to a sink that does its own checks. Also throws what the sink throws.
DUSTBENCH_API void streamVolume(const std::filesystem::path& file, const VolumeFields& fields, VolumeSink& sink);

/// Throws InputError unless `density` is 0 or more, apart from small overshoots relative to the highest, `maximum`.
DUSTBENCH_API void requireDensity(float density, float maximum, const std::filesystem::path& file, bool clampsDensity);

/// `.vti`: cell data of three components, time from the field data `TimeValue`; `.vdb`: a grid of vectors, time from
/// its metadata `time_s`. Throws InputError with the file and the fault in one line.
[[nodiscard]] DUSTBENCH_API VectorGrid readVectors(const std::filesystem::path& file, const std::string& field);

}  // namespace dustbench::volumes
