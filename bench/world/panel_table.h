// Reads the panels of a scene, its `[[panel]]` tables, and the reliefs on them. `data/scenes/relief_wall.toml` and
// `data/reliefs/bricks.toml` document the keys.
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "methods/contract/scene.h"
#include "methods/kit/files/toml_reader.h"

namespace dustbench::world {

/// Reads one table. Panels with the same relief share it; `files` gets the relief's files. Throws InputError with file,
/// line and what was expected, also for a panel of the world that extends into the ground or another panel of `scene`.
[[nodiscard]] scene::Panel readPanel(files::TomlReader& table, const std::filesystem::path& sceneFile,
                                     const scene::Scene& scene, std::vector<std::filesystem::path>& files);

/// True if the two plates have a point in common. Both must be in the frame of the same parent.
[[nodiscard]] bool overlap(const scene::Panel& one, const scene::Panel& other);

/// A relief from its own file, which names its heights and colours as pictures.
struct ReliefFile {
    std::string description;
    std::shared_ptr<const scene::Relief> relief;
    std::vector<std::filesystem::path> files;  ///< this file and the pictures that it names
};

/// Throws InputError with the file and what was expected.
[[nodiscard]] ReliefFile readRelief(const std::filesystem::path& file);

}  // namespace dustbench::world
