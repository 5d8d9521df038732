// Reads the panels of a scene: its `[[panel]]` tables. `data/scenes/relief_wall.toml` documents the keys.
#pragma once

#include <filesystem>
#include <vector>

#include "methods/contract/scene.h"
#include "methods/kit/files/toml_reader.h"

namespace dustbench::bench {

/// Reads one table. Panels with the same relief share it; `files` gets the relief's files. Throws InputError with file,
/// line and what was expected, also for a panel of the world that extends into the ground or another panel of `scene`.
[[nodiscard]] scene::Panel readPanel(files::TomlReader& table, const std::filesystem::path& sceneFile,
                                     const scene::Scene& scene, std::vector<std::filesystem::path>& files);

/// True if the two plates have a point in common. Both must be in the frame of the same parent.
[[nodiscard]] bool overlap(const scene::Panel& one, const scene::Panel& other);

}  // namespace dustbench::bench
