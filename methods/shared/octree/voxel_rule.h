// Which of several particles in one voxel it stands for, and how much mass it holds.
//
// Units: m² (optical mass). Threads: pure.
// The paper is silent on particles that share a voxel (claims C9): these policies are ours.
#pragma once

#include <bit>
#include <cstdint>

#include "methods/shared/maths/transmittance.h"
#include "methods/shared/octree/octree_settings.h"
#include "methods/shared/particles/particle_store.h"

namespace dustbench::octree {

/// `max`: the highest peak opacity α wins; `youngest` and `accumulate`: the lowest age. Ties go to the lower serial, so
/// that the winner does not depend on the order in which particles come.
class VoxelRule {
 public:
    VoxelRule(const particles::ParticleStore& store, OpacityPolicy policy)
        : store_(&store),
          policy_(policy),
          values_(policy == OpacityPolicy::max ? store.opacity.data() : store.age.data()),
          flip_(policy == OpacityPolicy::max ? 0u : ~0u) {}

    [[nodiscard]] bool accumulates() const { return policy_ == OpacityPolicy::accumulate; }

    /// The higher wins. Floats of one sign order as their bits do.
    [[nodiscard]] std::uint32_t priority(std::uint32_t particle) const {
        return std::bit_cast<std::uint32_t>(values_[particle]) ^ flip_;
    }
    [[nodiscard]] bool wins(std::uint32_t challenger, std::uint32_t holder) const {
        const std::uint32_t a = priority(challenger), b = priority(holder);
        return a != b ? a > b : firstBorn(challenger, holder);
    }
    [[nodiscard]] bool firstBorn(std::uint32_t a, std::uint32_t b) const {
        return store_->serial[a] < store_->serial[b];
    }
    /// τ·2π·s² of one particle.
    [[nodiscard]] double massSquareMetres(std::uint32_t particle) const {
        return maths::puffMassSquareMetres(static_cast<double>(store_->opacity[particle]),
                                           static_cast<double>(store_->radius[particle]));
    }

 private:
    const particles::ParticleStore* store_;
    OpacityPolicy policy_;
    const float* values_;
    std::uint32_t flip_;
};

}  // namespace dustbench::octree
