// The paper's voxeliser on the GPU: the mesh is drawn layer by layer, seen along z, between two planes a voxel apart.
//
// A pixel that is drawn marks its voxel. The depth buffer tells that, not the colour: the model's may be that of the
// background. The colour becomes the voxel's.
//
// Frame: the mesh's own. Threads: the OpenGL thread's. Source: JuckelBeckhaus2007, 4.2.
#pragma once

#include "methods/kit/gpu/device.h"
#include "methods/voxel_shape/voxels/marked_voxels.h"

namespace dustbench::voxel_shape {

/// Along z, as in the paper. `background`: what the buffers are cleared to before each layer; the result does not
/// depend on it.
[[nodiscard]] MarkedVoxels slicePass(gpu::Device& device, const scene::Mesh& mesh, const Lattice& lattice,
                                     const glm::vec3& background = glm::vec3(0));

/// Departs from the paper: along x, y and z, so that no face is missed for being seen edge-on alone.
[[nodiscard]] MarkedVoxels slicesAlongAllAxes(gpu::Device& device, const scene::Mesh& mesh, const Lattice& lattice);

}  // namespace dustbench::voxel_shape
