// Stress as colour: a voxel changes towards a colour by how far its particles have been pushed, and particles take that
// on as they take on any colour of a voxel.
//
// With u the way from a particle's place of birth to where it is, both in the shape's own frame, a voxel that holds n
// particles has the displacement d = sqrt(Σ|u|²/n) and shows mix(its colour, the stress's, min(1, d/full)). A shape at
// rest or at constant velocity has d = 0 but for what particles drift by themselves (`birth_speed`); forces, air,
// solids and acceleration raise it.
//
// Source: JuckelBeckhaus2007, 6 (`visualization of stress fields`). Departs: the paper names no measure; its particles
// show stress by clusters alone.
// Units: m, linear RGB. Owns: colours and sums, on a ledger. Threads: one caller at a time.
#pragma once

#include "methods/kit/memory/memory_ledger.h"
#include "methods/voxel_shape/particles/shape_system.h"
#include "methods/voxel_shape/shape.h"

namespace dustbench::voxel_shape {

class ShapeStress {
 public:
    /// Takes the voxels' colours for those without stress. From here on particles keep their places of birth; none may
    /// have been born yet.
    ShapeStress(MemoryLedger& ledger, ShapeSystem& system, const StressLook& look);

    /// Sets the voxels' colours. `system`: the one that it was made of.
    void showOn(ShapeSystem& system);
    /// Displacement d of each active voxel at the last `showOn`; 0 where it holds none.
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
