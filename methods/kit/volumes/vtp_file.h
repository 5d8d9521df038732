// Reads the points of VTK's poly data (`.vtp`): positions and arrays of numbers. Cells are passed over.
//
// As vti_file.h: the structure is held to a whitelist, every length to the file's, before memory is allocated.
// Source: Kitware2021, "XML file formats". Departs: one piece; compressed by zlib or LZ4 or not at all.
// Units and frame: the file's own.
#pragma once

#include <filesystem>
#include <string>

#include "methods/kit/volumes/point_table.h"

namespace dustbench::volumes {

/// The positions are the column `Points`; the time is the field data `TimeValue`. Throws InputError with the file and
/// what is wrong, in one line.
[[nodiscard]] DUSTBENCH_API PointTable readVtp(const std::filesystem::path& file, const WantsColumn& wants);

}  // namespace dustbench::volumes
