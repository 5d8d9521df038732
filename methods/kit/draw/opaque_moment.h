// What all shaders of the opaque scene share: the uniforms of one frame (view, lights and shadows), laid out as the
// uniform block of opaque_moment.glsl (std140), and the preprocessor definitions.
//
// Frame: `eye` positions use the world's axes, relative to the camera's eye, so that floats stay precise far from the
// world's origin.
#pragma once

#include <array>
#include <glm/glm.hpp>
#include <map>
#include <string>

#include "methods/kit/draw/shadow_map.h"

namespace dustbench::draw {

inline constexpr std::size_t maximumLamps = 64;

struct OpaqueMoment {
    glm::mat4 eyeToClip{1};
    glm::mat4 clipToEye{1};
    glm::mat4 eyeToVehicleShadow{1};  ///< to texture coordinates and depth
    glm::mat4 eyeToSolidShadow{1};
    glm::mat4 eyeToVehicle{1};  ///< to the vehicle frame
    glm::mat4 eyeToDust{1};     ///< DustShadow::eyeToTexture
    glm::vec4 toSun{0, 1, 0, 0};
    glm::vec4 sun{0};
    glm::vec4 ambient{0};
    glm::vec4 groundLight{0};  ///< light reflected upwards by the lit ground
    glm::vec4 skyZenith{0};
    glm::vec4 skyHorizon{0};    ///< w: extinction of the clear air per metre
    glm::vec4 shadowTexels{0};  ///< metres per texel: vehicle, solids
    glm::vec4 underside{0};     ///< the vehicle's outline on the ground: centre x, z; half-extent x, z
};

/// The uniforms of opaque_lamps.glsl (std140): the lamps of one frame, `eye` positions.
struct OpaqueLamps {
    struct Lamp {
        glm::vec4 place{0};  ///< w: its radius, squared
        glm::vec4 intensity{0};
    };
    glm::ivec4 count{0};  ///< x
    std::array<Lamp, maximumLamps> lamps;
};

/// VEHICLE and SOLIDS if the scene has such shadow casters; DUST if dust casts a shadow; LAMPS with lamps.
[[nodiscard]] inline std::map<std::string, std::string> opaqueDefinitions(const scene::Scene& scene, bool lamps) {
    std::map<std::string, std::string> result = shadowCasters(scene);
    if (scene.lights.onDust) result.emplace("DUST", "1");
    if (lamps) result.insert({{"LAMPS", "1"}, {"MAXIMUM_LAMPS", std::to_string(maximumLamps)}});
    return result;
}

}  // namespace dustbench::draw
