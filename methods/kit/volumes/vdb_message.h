// What the program that reads a `.vdb` writes to its standard output: this header, then the reason why it reads
// nothing, or the vectors, three floats a cell, x fastest. Of points, each column is a header and its numbers, as
// doubles, point by point.
#pragma once

#include <cstdint>

namespace dustbench::volumes {

inline constexpr const char* vdbReaderName = "dustbench_vdb_reader";

struct VdbMessage {
    std::uint64_t reasonBytes = 0;  ///< 0: vectors or columns follow
    std::uint64_t points = 0;
    std::int32_t columns = 0, unused = 0;
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
