// Writes what stands around the cloud as a VTK multi-block: the ground, the car and every solid where it is.
#pragma once

#include <filesystem>
#include <glm/glm.hpp>

#include "bench/export/volume_settings.h"
#include "methods/contract/scene.h"

namespace dustbench::bench {

/// The part of the ground that lies under a cloud and under the vehicle, with a margin around; of a plane, which costs
/// nothing, also what lies under the solids.
[[nodiscard]] Box groundAround(const std::optional<Box>& cloud, const scene::Scene& scene,
                               const scene::SceneState& state);

/// Blocks `terrain`, `body`, `wheel_front_left` … and the solids by their names, in world coordinates, with normals and
/// (but for the ground) 8-bit sRGB `colour`. `ground` says which part of it, by x and z. The pieces lie in a folder
/// beside `file` that has its name; the file appears after them. Throws InputError where it cannot be written.
void writeScene(const scene::Scene& scene, const scene::SceneState& state, const Box& ground, double timeSeconds,
                const std::filesystem::path& file);

}  // namespace dustbench::bench
