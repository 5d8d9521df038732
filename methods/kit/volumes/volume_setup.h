// What is said of a volume besides its files: which fields it shows, where it stands and how it looks.
//
// Units: metres, seconds, extinction per metre. Frame: world (+Y up). Colours: linear RGB.
#pragma once

#include <filesystem>
#include <glm/glm.hpp>
#include <optional>
#include <string>
#include <string_view>

namespace dustbench::volumes {

/// Names of a file's fields; empty: the usual ones.
struct VolumeFields {
    std::string density, temperature, velocity;
    bool wantsTemperature = false;  ///< missing is then an error
    bool clampsDensity = false;     ///< below zero counts as zero, else is an error
    bool isSparse = false;          ///< who reads keeps no whole box, which may have limits::sparseVolumeCells
};

struct VolumeSetup {
    std::string description;
    std::filesystem::path files;           ///< one, several by a `*`, or a series that names them
    std::optional<double> secondsPerFile;  ///< of files without times
    bool zUp = false;
    double metresPerUnit = 1;
    glm::dvec3 position{0};  ///< metres, added to the files' places
    VolumeFields fields;
    double extinctionPerMetre = 1;                   ///< at a density of 1
    std::optional<glm::vec3> albedo;                 ///< empty: the scene's dust
    int shadowCells = 0;                             ///< blocks of the light volume; 0: no shadows
    std::filesystem::path fire;                      ///< transfer function of the temperature; empty: no fire
    double coldTemperature = 0, hotTemperature = 1;  ///< where fire begins, and is freshest
    int blockCells = 1;                              ///< edge of the blocks of cells that become one particle each
};

/// What a volume may end in: a file, a list of files, and what is said of them.
inline constexpr std::string_view volumeExtensions = ".vti|.vdb|.nvdb|.pvd|.series|.toml";

/// Of a `.toml` that names the files, or of the files themselves, by the usual names. Throws InputError with file and
/// line.
[[nodiscard]] DUSTBENCH_API VolumeSetup readVolumeSetup(const std::filesystem::path& path);

}  // namespace dustbench::volumes
