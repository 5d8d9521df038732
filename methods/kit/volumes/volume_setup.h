// Settings of a volume in addition to its files: the fields to show, the position and the appearance.
//
// Units: metres, seconds, extinction per metre. Frame: world (+Y up). Colours: linear RGB.
#pragma once

#include <filesystem>
#include <glm/glm.hpp>
#include <optional>
#include <string>
#include <string_view>

namespace dustbench::volumes {

/// Names of a file's fields; empty: the default ones.
struct VolumeFields {
    std::string density, temperature, velocity;
    bool wantsTemperature = false;  ///< a missing one is then an error
    bool clampsDensity = false;     ///< negative values count as zero; otherwise they are an error
    bool isSparse = false;          ///< the reader does not store the whole box, of up to limits::sparseVolumeCells
};

struct VolumeSetup {
    std::string description;
    std::filesystem::path files;           ///< one, several with a `*`, or a series that names them
    std::optional<double> secondsPerFile;  ///< for files without times
    bool zUp = false;
    double metresPerUnit = 1;
    glm::dvec3 position{0};  ///< metres, added to the files' positions
    VolumeFields fields;
    double extinctionPerMetre = 1;                   ///< at a density of 1
    std::optional<glm::vec3> albedo;                 ///< empty: the scene's dust
    int shadowCells = 0;                             ///< blocks of the light volume; 0: no shadows
    std::filesystem::path fire;                      ///< transfer function of the temperature; empty: no fire
    double coldTemperature = 0, hotTemperature = 1;  ///< where fire begins, and where it is freshest
    int blockCells = 1;                              ///< edge of the blocks of cells that become one particle each
};

/// Extensions of a volume: a file, a list of files, or a file with settings.
inline constexpr std::string_view volumeExtensions = ".vti|.vdb|.nvdb|.pvd|.series|.toml";

/// Reads a `.toml` that names the files, or takes the files themselves with the default settings. Throws InputError
/// with file and line.
[[nodiscard]] DUSTBENCH_API VolumeSetup readVolumeSetup(const std::filesystem::path& path);

}  // namespace dustbench::volumes
