// The output of the program that reads a `.vdb`: this header, then the reason for a failure, or the vectors, three
// floats per cell, x fastest. For points, each column is a header and its numbers as doubles, point by point. For a
// volume, each field is a header and its floats, cell by cell. The ignored parts of the file follow the first header,
// as lines.
#pragma once

#include <cstdint>
#include <string_view>

namespace dustbench::volumes {

inline constexpr const char* vdbReaderName = "dustbench_vdb_reader";
/// The first argument or its prefix; then names of fields follow (field_request.h).
inline constexpr const char* pointsMode = "--points";
inline constexpr const char* volumeMode = "--volume=";
/// Reasons that name the missing content of an OpenVDB file.
inline constexpr const char* noPoints = "it has no grid of points";

/// Maximum size of the lines that name ignored parts.
inline constexpr std::int32_t maximumIgnoredBytes = 8'000;

/// The reason if the reader ends unexpectedly.
[[nodiscard]] inline const char* notWholeOf(std::string_view file) {
    return file.ends_with(".nvdb") ? "not a complete NanoVDB file" : "not a complete OpenVDB file";
}

struct VdbMessage {
    std::uint64_t reasonBytes = 0;  ///< 0: vectors or columns follow
    std::uint64_t points = 0;
    std::int32_t columns = 0, ignoredBytes = 0;
    std::int32_t cells[3] = {};
    std::int32_t hasTime = 0;
    double origin[3] = {};
    double spacing = 0, timeSeconds = 0;
};

struct VdbColumn {
    char name[124] = {};
    std::int32_t components = 1;
};

}  // namespace dustbench::volumes
