// What the light of a cloud is made of (kit/raycast/light_volume.h), found in the leaves of a sparse grid.
#pragma once

#include <span>
#include <vector>

#include "methods/kit/raycast/raycast_settings.h"
#include "methods/volume/sparse/sparse_moment.h"

namespace dustbench::volume {

/// The mean density of each block of `texelCells` cells of the box, x fastest; that of a cell counts as many times as
/// its fire's extinction factor says (`fire`: TransferFunction::table). Threads: runs in parallel.
void meanDensities(const SparseMoment& moment, std::span<const glm::vec4> fire, int texelCells,
                   std::span<float> averages);

/// Throws InputError if light takes more blocks than it may, or more along an axis than a texture has.
void requireLightFits(const SparseMoment& moment, int texelCells, bool onGpu);

}  // namespace dustbench::volume
