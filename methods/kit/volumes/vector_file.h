// Reads a field of vectors from one file, `.vti` or `.vdb`.
#pragma once

#include <filesystem>
#include <string>

#include "methods/kit/volumes/vector_grid.h"

namespace dustbench::volumes {

/// `.vti`: cell data of three components, time from the field data `TimeValue`; `.vdb`: a grid of vectors, time from
/// its metadata `time_s`. Throws InputError with the file and the fault in one line.
[[nodiscard]] DUSTBENCH_API VectorGrid readVectors(const std::filesystem::path& file, const std::string& field);

}  // namespace dustbench::volumes
