// Merges the particles of several shapes into one list, to sort and draw them together.
//
// Owns: a copy of the columns drawn, on a ledger; nothing if there is only one shape.
#pragma once

#include <span>

#include "methods/voxel_shape/living_shape.h"

namespace dustbench::voxel_shape {

class MergedParticles {
 public:
    explicit MergedParticles(MemoryLedger& ledger) : all_(ledger) {}

    /// Returns the particles of the only shape, or a copy of all: positions, velocities, looks and pictures. Valid
    /// until the next call or step.
    [[nodiscard]] const ShapeParticles& of(std::span<LivingShape> shapes);

 private:
    ShapeParticles all_;
};

}  // namespace dustbench::voxel_shape
