// Builds a shape's voxels from its description: finds and voxelises the mesh, fills and edits the voxels, and
// distributes the particles over them.
//
// Frame: the shape's own. Threads: the OpenGL thread's.
#pragma once

#include "methods/contract/scene.h"
#include "methods/kit/gpu/device.h"
#include "methods/voxel_shape/particles/shape_system.h"
#include "methods/voxel_shape/shape.h"

namespace dustbench::voxel_shape {

/// Returns the mesh of a shape: the vehicle with its wheels, in the vehicle's frame; or that of a file, turned and
/// scaled as described, standing on y = 0 and centred over the origin. Throws InputError.
[[nodiscard]] scene::Mesh meshOf(const Shape& shape, const scene::Scene& scene);

/// Builds voxels and particle system. Throws InputError if the description or the scene is unsuitable.
[[nodiscard]] ShapeSystem buildShape(MemoryLedger& ledger, const Shape& shape, const scene::Scene& scene,
                                     gpu::Device& device, std::uint64_t seed);

}  // namespace dustbench::voxel_shape
