// Reads the solids of a scene: its `[[solid]]` tables. `data/scenes/plain.toml` documents the keys.
#pragma once

#include <filesystem>
#include <vector>

#include "bench/scene/moving_solids.h"
#include "methods/contract/scene.h"
#include "methods/kit/files/toml_reader.h"

namespace dustbench::bench {

/// Reads all copies of one table into `scene`. Several copies are merged into one mesh in world coordinates; a single
/// one gets a pose, and a path in `moving` if it has keys. `files` gets its meshes. Throws InputError with file, line
/// and what was expected.
void readSolid(files::TomlReader& table, const std::filesystem::path& sceneFile, scene::Scene& scene,
               MovingSolids& moving, std::vector<std::filesystem::path>& files);

}  // namespace dustbench::bench
