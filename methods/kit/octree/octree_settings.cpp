#include "methods/kit/octree/octree_settings.h"

#include "methods/contract/errors.h"
#include "methods/kit/octree/lattice.h"

namespace dustbench::octree {

void declareOctreeParameters(ParameterSet& parameters) {
    parameters
        .integer("depth", 8, minimumDepth, maximumDepth, "levels",
                 "levels below the root; the finest voxels have edge world_edge / 2^depth")
        .integer("levels", 4, 1, maximumDepth, "levels", "levels that particles use, counted from the finest")
        .choice("policy", OpacityPolicy::max, opacityPolicies,
                "several particles in a voxel: the most opaque one, the youngest one, or the sum of their masses")
        .choice("level_rule", LevelRule::age, levelRules,
                "a particle's level: by its age, or the voxel edge closest to 1.253 times its radius");
}

OctreeSettings octreeSettings(const ParameterValues& values) {
    OctreeSettings settings;
    settings.depth = static_cast<int>(values.integer("depth"));
    settings.levels = static_cast<int>(values.integer("levels"));
    settings.policy = values.choice("policy", opacityPolicies);
    settings.levelRule = values.choice("level_rule", levelRules);
    if (settings.levels > settings.depth)
        throw InputError("parameter levels: got " + std::to_string(settings.levels) + ", allowed: 1.." +
                         std::to_string(settings.depth) + " (the depth)");
    return settings;
}

}  // namespace dustbench::octree
