// Reads a `.vdb` in a process of its own, because OpenVDB trusts what it reads: lengths in a damaged file make it write
// beyond its memory. What happens to that process is a reason to refuse the file.
//
// It runs the program dustbench_vdb_reader beside the kit (openvdb/), so that methods do not link OpenVDB.
#pragma once

#include <filesystem>
#include <string>

#include "methods/kit/volumes/point_table.h"
#include "methods/kit/volumes/vector_grid.h"
#include "methods/kit/volumes/volume_grid.h"
#include "methods/kit/volumes/volume_setup.h"
#include "methods/kit/volumes/volume_sink.h"

namespace dustbench::volumes {

/// A grid of vectors with the time from its metadata `time_s`. Empty if it was read, else the reason as one clause.
/// Throws std::runtime_error if the program cannot be started.
[[nodiscard]] std::string readVdb(const std::filesystem::path& file, const std::string& field, VectorGrid& grid);

/// The density of a `.vdb` or `.nvdb` within the box of its cells, and the other fields in the same cells. Likewise.
[[nodiscard]] std::string readVdbVolume(const std::filesystem::path& file, const VolumeFields& fields,
                                        VolumeGrid& grid);
/// The same, number by number as they arrive. Also throws what the sink throws.
[[nodiscard]] std::string streamVdbVolume(const std::filesystem::path& file, const VolumeFields& fields,
                                          VolumeSink& sink);

/// The one grid of points; its positions in the world are the column `Points`. Time as above. Throws InputError with
/// the file and what is wrong, in one line.
[[nodiscard]] DUSTBENCH_API PointTable readVdbPoints(const std::filesystem::path& file, const WantsColumn& wants);

/// The same; empty if the file has no grid of points.
[[nodiscard]] DUSTBENCH_API std::optional<PointTable> findVdbPoints(const std::filesystem::path& file,
                                                                    const WantsColumn& wants);

}  // namespace dustbench::volumes
