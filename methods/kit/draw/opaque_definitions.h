// The preprocessor definitions for all shaders of the opaque scene.
#pragma once

#include <map>
#include <string>

#include "methods/kit/draw/opaque_moment.h"
#include "methods/kit/draw/shadow_map.h"

namespace dustbench::draw {

/// VEHICLE and SOLIDS if the scene has such shadow casters; DUST if dust casts a shadow; LAMPS with lamps.
[[nodiscard]] inline std::map<std::string, std::string> opaqueDefinitions(const scene::Scene& scene, bool lamps) {
    std::map<std::string, std::string> result = shadowCasters(scene);
    if (scene.lights.onDust) result.emplace("DUST", "1");
    if (lamps) result.insert({{"LAMPS", "1"}, {"MAXIMUM_LAMPS", std::to_string(maximumLamps)}});
    return result;
}

}  // namespace dustbench::draw
