// Lights a shape by the scene's sun and sky: sets the colours of its voxels to those of a lit surface. Particles take
// on these colours like any other colour of a voxel.
//
// A voxel of albedo a and normal n has the colour a·(ambient + sun·max(0, n·l)), l: direction to the sun. Without a
// normal it gets half of the sun. Units: linear RGB. Frame: n and l in the shape's own. Owns: albedos and normals.
// Threads: one caller at a time.
#pragma once

#include <vector>

#include "methods/contract/scene.h"
#include "methods/kit/memory/memory_ledger.h"
#include "methods/voxel_shape/particles/pose.h"
#include "methods/voxel_shape/voxels/voxel_grid.h"

namespace dustbench::voxel_shape {

class ShapeLight {
 public:
    /// Takes the voxels' current colours as albedos.
    ShapeLight(MemoryLedger& ledger, const VoxelGrid& grid, const scene::Lights& lights);

    /// Sets the voxels' colours for this pose. `grid`: the grid given to the constructor.
    void shineOn(VoxelGrid& grid, const Pose& pose);

 private:
    scene::Lights lights_;
    LedgerVector<glm::vec4> albedos_, fadingAlbedos_;  ///< of active voxels, with their opacity
    LedgerVector<glm::vec3> normals_;
    glm::vec3 lastToSun_{0};  ///< in the shape's frame
};

}  // namespace dustbench::voxel_shape
