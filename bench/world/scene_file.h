// Reads a scene from TOML: ground, solids, panels, light, wind, vehicle, cameras. `data/scenes/plain.toml` documents
// the keys.
//
// Units in the file: SI, degrees; colours linear RGB.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "bench/world/cameras.h"
#include "bench/world/moving_solids.h"
#include "methods/contract/scene.h"
#include "methods/contract/terrain.h"

namespace dustbench::world {

/// Position and heading of the vehicle at the start of the drive.
struct Start {
    double x = 0;
    double z = 0;
    double heading = 0;
};

/// Name for no dust in a scene file.
inline constexpr const char* noDust = "none";

struct SceneFile {
    scene::Scene scene;
    MovingSolids movingSolids;
    CameraSet cameras;
    Start start;
    bool isDrawn = true;  ///< false: only the method's picture is visible, over the horizon's colour
    std::string description;
    std::string drive;                         ///< id of the default drive
    std::string dust;                          ///< id of the particle system for the wheels, or noDust
    std::vector<std::filesystem::path> files;  ///< this file and all files that it references
};

/// Throws InputError with file, line and what was expected.
[[nodiscard]] SceneFile readScene(const std::filesystem::path& file);

/// Unit vector to a sun at an elevation above the horizon. The azimuth is measured like headings: 0 at +X, increasing
/// towards −Z.
[[nodiscard]] glm::vec3 sunDirection(double elevation, double azimuth);

/// Reads a height field from an image. Uses the first channel as stored (no colour decoding): black is `baseMetres`,
/// white is `heightMetres` above. One sample per pixel, `spacingMetres` apart, with the image's centre at the world's
/// origin and its top row at minimum z. Throws InputError with the file and the reason.
[[nodiscard]] scene::Terrain readHeightImage(const std::filesystem::path& file, double spacingMetres,
                                             double heightMetres, double baseMetres);

}  // namespace dustbench::world
