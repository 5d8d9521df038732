// User settings of the tree for both octree methods, declared once, and their policies for particles that share a
// voxel.
//
// The paper does not state what happens to particles that share a voxel: these policies are ours. Threads: pure.
#pragma once

#include <bit>
#include <cstdint>

#include "methods/contract/parameters.h"
#include "methods/contract/volume.h"
#include "methods/kit/maths/transmittance.h"

namespace dustbench::octree {

/// Which particle's opacity a voxel of several particles takes; `accumulate` adds their optical masses.
enum class OpacityPolicy { max, youngest, accumulate };
inline constexpr Choices<OpacityPolicy> opacityPolicies{
    {"max", OpacityPolicy::max}, {"youngest", OpacityPolicy::youngest}, {"accumulate", OpacityPolicy::accumulate}};
/// What determines the size of a particle's voxel.
enum class LevelRule { age, radius };
inline constexpr Choices<LevelRule> levelRules{{"age", LevelRule::age}, {"radius", LevelRule::radius}};

struct OctreeSettings {
    int depth = 8;   ///< levels below the root; the finest cells have edge / 2^depth
    int levels = 4;  ///< number of levels that particles use, counted from the finest
    OpacityPolicy policy = OpacityPolicy::max;
    LevelRule levelRule = LevelRule::age;
};

/// Adds `depth`, `levels`, `policy` and `level_rule` to a method's parameters.
void declareOctreeParameters(ParameterSet& parameters);
/// Throws InputError if `levels` exceeds `depth`.
[[nodiscard]] OctreeSettings octreeSettings(const ParameterValues& values);

/// Which particle represents a voxel, and the voxel's optical mass in m².
///
/// `max`: the highest peak opacity α wins; `youngest` and `accumulate`: the lowest age. Ties go to the lower serial, so
/// that the winner does not depend on the order of the particles.
class VoxelRule {
 public:
    VoxelRule(const Puffs& store, OpacityPolicy policy)
        : serials_(store.serial.data()),
          opacities_(store.opacity.data()),
          radii_(store.radius.data()),
          policy_(policy),
          values_(policy == OpacityPolicy::max ? store.opacity.data() : store.age.data()),
          flip_(policy == OpacityPolicy::max ? 0u : ~0u) {}

    [[nodiscard]] bool accumulates() const { return policy_ == OpacityPolicy::accumulate; }

    /// The higher value wins. Floats of the same sign compare like their bits.
    [[nodiscard]] std::uint32_t priority(std::uint32_t particle) const {
        return std::bit_cast<std::uint32_t>(values_[particle]) ^ flip_;
    }
    [[nodiscard]] bool wins(std::uint32_t challenger, std::uint32_t holder) const {
        const std::uint32_t a = priority(challenger), b = priority(holder);
        return a != b ? a > b : firstBorn(challenger, holder);
    }
    [[nodiscard]] bool firstBorn(std::uint32_t a, std::uint32_t b) const { return serials_[a] < serials_[b]; }
    /// τ·2π·s² of one particle.
    [[nodiscard]] double massSquareMetres(std::uint32_t particle) const {
        return maths::puffMassSquareMetres(static_cast<double>(opacities_[particle]),
                                           static_cast<double>(radii_[particle]));
    }

 private:
    const std::uint64_t* serials_;
    const float* opacities_;
    const float* radii_;
    OpacityPolicy policy_;
    const float* values_;
    std::uint32_t flip_;
};

}  // namespace dustbench::octree
