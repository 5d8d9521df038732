// From a shape's description to its voxels: its mesh is found, voxelised, filled, edited, and its particles shared out.
//
// Frame: the shape's own. Threads: the OpenGL thread's.
#pragma once

#include "methods/contract/scene.h"
#include "methods/kit/gpu/device.h"
#include "methods/voxel_shape/particles/shape_system.h"
#include "methods/voxel_shape/shape.h"

namespace dustbench::voxel_shape {

/// The mesh that a shape is made of: the vehicle with its wheels, or a file's, turned and scaled as the shape says,
/// standing on y = 0 with its middle over the origin (the vehicle stays in its own frame). Throws InputError.
[[nodiscard]] scene::Mesh meshOf(const Shape& shape, const scene::Scene& scene);

/// Throws InputError for whatever does not fit.
[[nodiscard]] ShapeSystem buildShape(MemoryLedger& ledger, const Shape& shape, const scene::Scene& scene,
                                     gpu::Device& device, std::uint64_t seed);

}  // namespace dustbench::voxel_shape
