// What the program that reads a `.vdb` writes to its standard output: this header, then the reason why it reads
// nothing, or the vectors, three floats a cell, x fastest. Of points, each column is a header and its numbers, as
// doubles, point by point. Of a volume, each field is a header and its floats, cell by cell. What of the file is not
// answered follows the first header, as lines.
#pragma once

#include <cstdint>
#include <string_view>

namespace dustbench::volumes {

inline constexpr const char* vdbReaderName = "dustbench_vdb_reader";
/// What its first argument is, or begins with: then names of fields follow (field_request.h).
inline constexpr const char* pointsMode = "--points";
inline constexpr const char* volumeMode = "--volume=";
/// A reason that says what a file of OpenVDB is not.
inline constexpr const char* noPoints = "it has no grid of points";

/// Of the lines that name what is ignored.
inline constexpr std::int32_t maximumIgnoredBytes = 8'000;

/// The reason where what reads ends in any other way than it should.
[[nodiscard]] inline const char* notWholeOf(std::string_view file) {
    return file.ends_with(".nvdb") ? "not a whole file of NanoVDB" : "not a whole file of OpenVDB";
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
