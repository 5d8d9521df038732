// Reads a `.vdb` in a separate process, because OpenVDB trusts its input: wrong lengths in a damaged file make it write
// out of bounds. If that process fails, the file is refused.
//
// Runs the program dustbench_vdb_reader next to the kit (openvdb/), so that methods do not link OpenVDB.
// Threads: one at a time for each process.
#pragma once

#include <sys/types.h>

#include <cstddef>
#include <filesystem>
#include <string>

#include "methods/kit/volumes/grid_place.h"
#include "methods/kit/volumes/point_table.h"
#include "methods/kit/volumes/volume_setup.h"

namespace dustbench::volumes {

/// Reads a grid of vectors, with the time from its metadata `time_s`. Returns an empty text, or the reason for the
/// failure as one clause. Throws std::runtime_error if the program cannot be started.
[[nodiscard]] std::string readVdb(const std::filesystem::path& file, const std::string& field, VectorGrid& grid);

/// Reads the density of a `.vdb` or `.nvdb` in the box of its cells, and the other fields in the same cells. Likewise.
[[nodiscard]] std::string readVdbVolume(const std::filesystem::path& file, const VolumeFields& fields,
                                        VolumeGrid& grid);
/// The same, value by value as they arrive. Also throws what the sink throws.
[[nodiscard]] std::string streamVdbVolume(const std::filesystem::path& file, const VolumeFields& fields,
                                          VolumeSink& sink);

/// Reads the only grid of points; its positions in the world are the column `Points`. Time as above. Throws InputError
/// with the file and the fault in one line.
[[nodiscard]] DUSTBENCH_API PointTable readVdbPoints(const std::filesystem::path& file, const WantsColumn& wants);

/// The same; empty if the file has no grid of points.
[[nodiscard]] DUSTBENCH_API std::optional<PointTable> findVdbPoints(const std::filesystem::path& file,
                                                                    const WantsColumn& wants);

/// A process that reads a `.vdb`, and its output (vdb_message.h). Owns: the process and our end of its output.
class VdbPipe {
 public:
    VdbPipe(pid_t process, int output) : process_(process), output_(output) {}
    ~VdbPipe() { (void)ended(); }
    VdbPipe(const VdbPipe&) = delete;
    VdbPipe& operator=(const VdbPipe&) = delete;

    /// False at the end of the output.
    [[nodiscard]] bool read(void* to, std::size_t bytes);
    /// True if no output was left and it exited with success. Waits for its end.
    [[nodiscard]] bool ended();

 private:
    pid_t process_;
    int output_;
};

/// Starts dustbench_vdb_reader with these arguments; the one that names a file is relative to this process's folder.
/// Throws std::runtime_error.
[[nodiscard]] VdbPipe startVdbReader(const std::string& first, const std::string& second);

}  // namespace dustbench::volumes
