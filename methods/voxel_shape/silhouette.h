// Measures how well a picture of particles reproduces the outline of the mesh that they represent.
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

/// Returns 1 for each pixel whose centre the mesh in this pose covers, otherwise 0. Triangles that reach behind the
/// near plane are omitted.
[[nodiscard]] std::vector<std::uint8_t> silhouetteOf(const scene::Mesh& mesh, const Pose& pose,
                                                     const scene::View& view);

/// Returns intersection over union of the mask and the pixels whose alpha in `layer` is above one half; empty if both
/// are empty. Throws std::invalid_argument for different sizes.
[[nodiscard]] std::optional<double> overlapOf(const std::vector<std::uint8_t>& mask, const pictures::Image& layer);

}  // namespace dustbench::voxel_shape
