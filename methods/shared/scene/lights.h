// Sun, sky and air. Colours are linear RGB; a white surface facing a sun of 1 reads 1.
#pragma once

#include <glm/glm.hpp>

namespace dustbench::scene {

struct Lights {
    glm::vec3 toSun{-0.933013f, 0.258819f, -0.25f};  ///< unit vector towards the sun: 15° up, 165° from +X to −Z
    glm::vec3 sun{1.0f, 0.93f, 0.80f};
    glm::vec3 ambient{0.40f, 0.42f, 0.48f};  ///< from the sky, the same from all sides
    glm::vec3 skyZenith{0.16f, 0.33f, 0.68f};
    glm::vec3 skyHorizon{0.74f, 0.80f, 0.86f};
    float hazePerMetre = 0.0015f;  ///< extinction of the clear air towards the horizon's colour
};

}  // namespace dustbench::scene
