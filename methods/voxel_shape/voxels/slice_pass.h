// The paper's voxeliser on the GPU: draws the mesh layer by layer along z, between two planes one voxel apart.
//
// A pixel that is drawn marks its voxel and gives it its colour. The test uses the depth buffer, not the colour, since
// the model may have the colour of the background.
//
// Frame: the mesh's own. Threads: the OpenGL thread's. Source: JuckelBeckhaus2007, 4.2.
#pragma once

#include "methods/kit/gpu/device.h"
#include "methods/voxel_shape/voxels/lattice.h"

namespace dustbench::voxel_shape {

/// Slices along z, as in the paper. `background`: the colour to which the buffers are cleared before each layer; the
/// result does not depend on it.
[[nodiscard]] MarkedVoxels slicePass(gpu::Device& device, const scene::Mesh& mesh, const Lattice& lattice,
                                     const glm::vec3& background = glm::vec3(0));

/// Slices along x, y and z, which departs from the paper: a face that is edge-on to one axis is not missed.
[[nodiscard]] MarkedVoxels slicesAlongAllAxes(gpu::Device& device, const scene::Mesh& mesh, const Lattice& lattice);

}  // namespace dustbench::voxel_shape
