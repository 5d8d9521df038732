// Sun, sky and air. Colours are linear RGB; a white surface facing a sun of 1 reads 1.
#pragma once

#include <glm/glm.hpp>

namespace dustbench::scene {

struct Lights {
    glm::vec3 toSun{0.45f, 0.62f, 0.64f};  ///< unit vector towards the sun
    glm::vec3 sun{1.0f, 0.93f, 0.80f};
    glm::vec3 ambient{0.30f, 0.34f, 0.42f};  ///< from the sky, the same from all sides
    glm::vec3 skyZenith{0.16f, 0.33f, 0.68f};
    glm::vec3 skyHorizon{0.74f, 0.80f, 0.86f};
    float hazePerMetre = 0.0015f;  ///< extinction of the clear air towards the horizon's colour
};

}  // namespace dustbench::scene
