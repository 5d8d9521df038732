// Lights a shape by the scene's sun and sky: its voxels' colours become those of a surface that looks where matter
// becomes less, and particles take them on as they take on any colour of a voxel.
//
// A voxel of albedo a and normal n shows a·(ambient + sun·max(0, n·l)), l towards the sun; without a normal half of the
// sun. Units: linear RGB. Frame: n and l in the shape's own. Owns: albedos and normals. Threads: one caller at a time.
#pragma once

#include <vector>

#include "methods/contract/scene.h"
#include "methods/kit/memory/memory_ledger.h"
#include "methods/voxel_shape/particles/pose.h"
#include "methods/voxel_shape/voxels/voxel_grid.h"

namespace dustbench::voxel_shape {

class ShapeLight {
 public:
    /// Takes the voxels' colours for albedos.
    ShapeLight(MemoryLedger& ledger, const VoxelGrid& grid, const scene::Lights& lights);

    /// Sets the voxels' colours to what they show in this pose. `grid`: the one that it was made of.
    void shineOn(VoxelGrid& grid, const Pose& pose);

 private:
    scene::Lights lights_;
    LedgerVector<glm::vec4> albedos_, fadingAlbedos_;  ///< of active voxels, with their opacity
    LedgerVector<glm::vec3> normals_;
    glm::vec3 lastToSun_{0};  ///< in the shape's frame
};

}  // namespace dustbench::voxel_shape
