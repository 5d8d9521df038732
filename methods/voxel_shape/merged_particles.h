// The particles of several shapes as one list, so that they are sorted and drawn together.
//
// Owns: a copy of what is drawn of them, on a ledger; none where there is one shape alone.
#pragma once

#include <span>

#include "methods/voxel_shape/living_shape.h"

namespace dustbench::voxel_shape {

class MergedParticles {
 public:
    explicit MergedParticles(MemoryLedger& ledger) : all_(ledger) {}

    /// The only shape's own particles, or a copy of all: positions, velocities, looks and pictures. Valid until the
    /// next call or step.
    [[nodiscard]] const ShapeParticles& of(std::span<LivingShape> shapes);

 private:
    ShapeParticles all_;
};

}  // namespace dustbench::voxel_shape
