// Writes the surroundings of the cloud as a VTK multi-block: the ground, the car and every solid at its pose.
#pragma once

#include <filesystem>
#include <glm/glm.hpp>

#include "bench/export/volume_settings.h"
#include "methods/contract/scene.h"

namespace dustbench::exports {

/// The part of the ground under the cloud and the vehicle, with a margin. For a flat ground, where size costs nothing,
/// also the part under the solids.
[[nodiscard]] Box groundAround(const std::optional<Box>& cloud, const scene::Scene& scene,
                               const scene::SceneState& state);

/// Writes blocks `terrain`, `body`, `wheel_front_left` … and the solids by name, in world coordinates, with normals and
/// (except for the ground) 8-bit sRGB `colour`. `ground` selects its part by x and z. The pieces are in the folder
/// `scene` next to `file`, named after their content, so that those that do not change exist once for all frames; the
/// file is written after them. Throws InputError if it cannot be written.
void writeScene(const scene::Scene& scene, const scene::SceneState& state, const Box& ground, double timeSeconds,
                const std::filesystem::path& file);

}  // namespace dustbench::exports
