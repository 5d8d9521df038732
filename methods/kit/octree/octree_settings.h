// User settings of the tree for both octree methods, declared once.
#pragma once

#include "methods/contract/parameters.h"

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

}  // namespace dustbench::octree
