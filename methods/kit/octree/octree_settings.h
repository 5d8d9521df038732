// What both octree methods let a person choose about the tree, declared once.
#pragma once

#include "methods/contract/parameters.h"

namespace dustbench::octree {

/// Which particle's opacity a voxel takes where several fall into it; `accumulate` adds their optical masses.
enum class OpacityPolicy { max, youngest, accumulate };
inline constexpr Choices<OpacityPolicy> opacityPolicies{
    {"max", OpacityPolicy::max}, {"youngest", OpacityPolicy::youngest}, {"accumulate", OpacityPolicy::accumulate}};
/// What decides how large a particle's voxel is.
enum class LevelRule { age, radius };
inline constexpr Choices<LevelRule> levelRules{{"age", LevelRule::age}, {"radius", LevelRule::radius}};

struct OctreeSettings {
    int depth = 8;   ///< levels below the root; the finest cells have edge / 2^depth
    int levels = 4;  ///< how many of them particles use, counted from the finest
    OpacityPolicy policy = OpacityPolicy::max;
    LevelRule levelRule = LevelRule::age;
};

/// Adds `depth`, `levels`, `policy` and `level_rule` to a method's parameters.
void declareOctreeParameters(ParameterSet& parameters);
/// Throws InputError where `levels` exceeds `depth`.
[[nodiscard]] OctreeSettings octreeSettings(const ParameterValues& values);

}  // namespace dustbench::octree
