// The interface to the writer of OpenVDB files, in a library that is loaded on first use.
//
// Linking OpenVDB took 33 of the 47 ms of every start, and only exports need it. openvdb/ implements this interface; it
// is built as libdustbench_openvdb.so next to the kit. Units: metres, seconds. Frame: world. Ownership: the values are
// read, not kept. Threads: any; calls are independent.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <glm/vec3.hpp>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace dustbench::exports {

/// One grid of a file, dense: cell by cell, x fastest. Zeros are not stored.
struct VdbField {
    std::string name, unit;
    int components = 1;  ///< 1: a fog volume, 3: vectors
    bool half = false;   ///< stored as half floats
    std::span<const float> values{};
};

/// What an OpenVDB file holds. All grids have the same cells.
struct VdbContents {
    std::array<int, 3> cells{};
    double spacingMetres = 0;
    glm::dvec3 originMetres{0};  ///< the corner of the first cell
    std::int64_t frame = 0;
    double timeSeconds = 0;
    std::vector<VdbField> fields{};
};

/// Why a file was not written: OpenVDB's message, or, if that is empty, the system's error number.
struct VdbFailure {
    int errorNumber = 0;
    std::string message{};
};

class VdbLibrary {
 public:
    virtual ~VdbLibrary() = default;

    /// Replaces `file`, which may be left incomplete after a failure. Nothing: it was written.
    [[nodiscard]] virtual std::optional<VdbFailure> write(const VdbContents& contents,
                                                          const std::filesystem::path& file) const = 0;
};

}  // namespace dustbench::exports
