// Outlines of a method's primitives: the quad around each puff, the twelve edges of each voxel.
//
// Neither the scene nor other primitives hide them. Units: pixels. Frame: rows from the top. Threads: pure.
#pragma once

#include "bench/export/collected_volume.h"
#include "bench/measure/image/picture.h"
#include "methods/contract/view.h"
#include "methods/kit/pictures/image.h"

namespace dustbench::bench {

/// How many outlines pass through each pixel.
struct Outlines {
    Plane quads;   ///< of puffs: squares that face the camera, with half side 1.5 r, as in overdrawMap
    Plane voxels;  ///< edges of the octrees' voxels, clipped in front of the eye
};
[[nodiscard]] Outlines outlinesOf(const CollectedVolume& volume, const scene::View& view);

/// Draws quads yellow and voxels blue over the darkened picture, brighter where several overlap. Linear light. Throws
/// std::invalid_argument if the sizes differ.
[[nodiscard]] pictures::Image withOutlines(pictures::Image picture, const Outlines& outlines);

}  // namespace dustbench::bench
