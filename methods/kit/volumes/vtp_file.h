// Reads the points of VTK's poly data (`.vtp`): positions and arrays of numbers. Cells are ignored.
//
// As in vti_file.h, the structure is checked against a whitelist, and every length before memory is allocated.
// Source: Kitware2021, "XML file formats". Departs: one piece; compressed by zlib or LZ4 or not at all.
// Units and frame: the file's own.
#pragma once

#include <filesystem>
#include <string>

#include "methods/kit/volumes/point_table.h"

namespace dustbench::volumes {

/// The positions are the column `Points`; the time is the field data `TimeValue`. Throws InputError with the file and
/// the fault in one line.
[[nodiscard]] DUSTBENCH_API PointTable readVtp(const std::filesystem::path& file, const WantsColumn& wants);

}  // namespace dustbench::volumes
