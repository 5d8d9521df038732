// Computes the input of a light volume (kit/raycast/light_volume.h) from the leaves of a sparse grid.
#pragma once

#include <span>
#include <vector>

#include "methods/kit/raycast/raycast_settings.h"
#include "methods/volume/sparse/sparse_moment.h"

namespace dustbench::volume {

/// The mean density of each block of `texelCells` cells of the box, x fastest. The density of a cell is multiplied by
/// its fire's extinction factor (`fire`: TransferFunction::table). Threads: runs in parallel.
void meanDensities(const SparseMoment& moment, std::span<const glm::vec4> fire, int texelCells,
                   std::span<float> averages);

/// Throws InputError if the light needs too many blocks, or more along an axis than a texture supports.
void requireLightFits(const SparseMoment& moment, int texelCells, bool onGpu);

}  // namespace dustbench::volume
