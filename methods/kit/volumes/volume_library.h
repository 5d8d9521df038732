// The interface to VTK and OpenVDB for reading volumes, in a library that is loaded on first use.
//
// vtk_openvdb/ implements it, built as libdustbench_volumes.so beside the program, so that methods link neither.
// Units and frame: the file's own. Errors: returned as text, empty on success. Threads: one caller at a time.
#pragma once

#include <filesystem>
#include <glm/glm.hpp>
#include <optional>
#include <string>
#include <vector>

namespace dustbench::volumes {

/// Vectors at the centres of cubic cells; x runs fastest, z slowest.
struct VectorGrid {
    glm::ivec3 cells{0};
    glm::dvec3 origin{0};  ///< minimum corner of the first cell
    double spacing = 0;    ///< edge of a cell
    std::optional<double> timeSeconds;
    bool sparse = false;  ///< cells beyond it are zero, not unknown
    std::vector<glm::vec3> values;
};

class VolumeLibrary {
 public:
    virtual ~VolumeLibrary() = default;

    /// `.vti`: cell data of three components, time from the field data `TimeValue`; `.vdb`: a grid of vectors, time
    /// from its metadata `time_s`.
    [[nodiscard]] virtual std::string readVectors(const std::filesystem::path& file, const std::string& field,
                                                  VectorGrid& grid) const = 0;
};

/// Loads the library on first call. Throws std::runtime_error if it is not beside the program.
[[nodiscard]] DUSTBENCH_API const VolumeLibrary& volumeLibrary();

}  // namespace dustbench::volumes
