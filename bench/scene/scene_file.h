// Reads a scene from TOML: ground, solids, light, wind, vehicle, cameras. `data/scenes/plain.toml` is the manual of its
// keys.
//
// Units in the file: SI, degrees; colours linear RGB.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "bench/scene/cameras.h"
#include "methods/contract/scene.h"

namespace dustbench::bench {

/// Where the vehicle is when the drive begins.
struct Start {
    double x = 0;
    double z = 0;
    double heading = 0;
};

struct SceneFile {
    scene::Scene scene;
    CameraSet cameras;
    Start start;
    std::string description;
    std::string drive;                         ///< id of the drive that is used where no other is named
    std::string dust;                          ///< id of the particle system of the wheels
    std::vector<std::filesystem::path> files;  ///< this file and all that it names
};

/// Throws InputError with file, line and what was expected.
[[nodiscard]] SceneFile readScene(const std::filesystem::path& file);

/// Unit vector to a sun at an elevation above the horizon and an azimuth counted like headings: 0 at +X, growing
/// towards −Z.
[[nodiscard]] glm::vec3 sunDirection(double elevation, double azimuth);

}  // namespace dustbench::bench
