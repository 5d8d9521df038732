// How well a picture of particles keeps the outline of the mesh that they stand for.
//
// Units: pixels, rows from the top. Threads: pure.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "methods/contract/solid.h"
#include "methods/contract/view.h"
#include "methods/kit/pictures/image.h"
#include "methods/voxel_shape/particles/pose.h"

namespace dustbench::voxel_shape {

/// 1 where a mesh in a pose covers the middle of a pixel. Triangles that reach behind the near plane are left out.
[[nodiscard]] std::vector<std::uint8_t> silhouetteOf(const scene::Mesh& mesh, const Pose& pose,
                                                     const scene::View& view);

/// Intersection over union of the mask and the pixels whose alpha in `layer` is above one half; empty where there are
/// neither. Throws std::invalid_argument for different sizes.
[[nodiscard]] std::optional<double> overlapOf(const std::vector<std::uint8_t>& mask, const pictures::Image& layer);

}  // namespace dustbench::voxel_shape
