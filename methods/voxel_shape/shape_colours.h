// Colours of a shape's voxels that change with time: by the scene's light, and by stress. Particles take them on like
// any other colour of a voxel.
//
// Units: m, linear RGB. Owns: colours, normals and sums, on a ledger. Threads: one caller at a time.
#pragma once

#include <vector>

#include "methods/contract/scene.h"
#include "methods/kit/memory/memory_ledger.h"
#include "methods/voxel_shape/particles/pose.h"
#include "methods/voxel_shape/particles/shape_system.h"
#include "methods/voxel_shape/shape.h"
#include "methods/voxel_shape/voxels/voxel_grid.h"

namespace dustbench::voxel_shape {

/// Lights a shape by the scene's sun and sky: sets the colours of its voxels to those of a lit surface.
///
/// A voxel of albedo a and normal n has the colour a·(ambient + sun·max(0, n·l)), l: direction to the sun, n and l in
/// the shape's own frame. Without a normal it gets half of the sun.
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

/// Shows stress as colour: a voxel's colour changes with the displacement of its particles.
///
/// Let u be the vector from a particle's place of birth to its position, both in the shape's own frame. A voxel that
/// holds n particles has the displacement d = sqrt(Σ|u|²/n); its colour is mix(own, stress, min(1, d/full)). A shape at
/// rest or at constant velocity has d = 0 except for the particles' own drift (`birth_speed`); forces, air, solids and
/// acceleration increase d.
///
/// Source: JuckelBeckhaus2007, 6 (`visualization of stress fields`). Departs: the paper names no measure and shows
/// stress only by clusters of particles.
class ShapeStress {
 public:
    /// Takes the voxels' current colours as those without stress. From then on particles keep their places of birth;
    /// none may exist yet.
    ShapeStress(MemoryLedger& ledger, ShapeSystem& system, const StressLook& look);

    /// Sets the voxels' colours. `system`: the system given to the constructor.
    void showOn(ShapeSystem& system);
    /// Displacement d of each active voxel at the last `showOn`; 0 if it holds no particles.
    [[nodiscard]] std::span<const float> displacements() const { return displacements_; }

 private:
    struct Sum {
        float squares = 0, count = 0;
    };
    StressLook look_;
    LedgerVector<glm::vec4> colours_, fadingColours_;  ///< of active voxels
    LedgerVector<Sum> sums_;                           ///< of all voxels
    LedgerVector<float> displacements_;
};

}  // namespace dustbench::voxel_shape
