// What every shader of the opaque scene knows of one moment: the view, the lights, the shadows. Laid out as the
// uniform block of opaque_moment.glsl (std140).
//
// Frame: `eye` positions are along the world's axes, relative to the camera's eye: floats stay precise far from the
// world's origin.
#pragma once

#include <glm/glm.hpp>

namespace dustbench::draw {

struct OpaqueMoment {
    glm::mat4 eyeToClip{1};
    glm::mat4 clipToEye{1};
    glm::mat4 eyeToVehicleShadow{1};  ///< to texture coordinates and depth
    glm::mat4 eyeToSolidShadow{1};
    glm::mat4 eyeToVehicle{1};  ///< to the vehicle's own frame
    glm::vec4 toSun{0, 1, 0, 0};
    glm::vec4 sun{0};
    glm::vec4 ambient{0};
    glm::vec4 groundLight{0};  ///< what lit ground sends back up
    glm::vec4 skyZenith{0};
    glm::vec4 skyHorizon{0};    ///< w: extinction of the clear air per metre
    glm::vec4 shadowTexels{0};  ///< metres a texel: vehicle, solids
    glm::vec4 underside{0};     ///< the vehicle's outline on the ground: centre x, centre z, half x, half z
};

}  // namespace dustbench::draw
