// A place where smoke, heat, fuel and motion enter the fluid: a ball with a soft edge.
//
// Units: metres, seconds. Frame: world. Source: Senger2009, 4.3 (a Gaussian, times what varies with time).
// Departs: strengths are per second; how they vary with time is for the caller to say.
#pragma once

#include <glm/glm.hpp>

namespace dustbench::grid_fluid::flow {

struct FluidSource {
    glm::dvec3 centreMetres{0};
    double radiusMetres = 1;     ///< where the strength has fallen to e^−½
    float densityPerSecond = 0;  ///< added at the centre
    /// Added in all: Σ density·volume over the cells of fluid that it reaches grows by this, whatever solids cover.
    float amountM3PerSecond = 0;
    float kelvinPerSecond = 0;  ///< added at the centre
    float reaction = 0;         ///< raised to this, at the centre
    glm::vec3 velocityMetresPerSecond{0};
    float velocityPerSecond = 0;  ///< at which the air takes on the source's velocity; 0: not at all
};

}  // namespace dustbench::grid_fluid::flow
