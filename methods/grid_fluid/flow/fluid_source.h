// A source of smoke, heat, fuel and motion: a ball with a soft edge.
//
// Units: metres, seconds. Frame: world. Source: Senger2009, 4.3 (a Gaussian, times a function of time).
// Departs: strengths are per second; the caller varies them with time.
#pragma once

#include <glm/glm.hpp>

namespace dustbench::grid_fluid::flow {

struct FluidSource {
    glm::dvec3 centreMetres{0};
    double radiusMetres = 1;     ///< at which the strength has fallen to e^−½
    float densityPerSecond = 0;  ///< added at the centre
    /// Total amount added: Σ density·volume over the fluid cells that it reaches grows by this, even if solids cover
    /// part of it.
    float amountM3PerSecond = 0;
    float kelvinPerSecond = 0;  ///< added at the centre
    float reaction = 0;         ///< at the centre, raised to at least this
    glm::vec3 velocityMetresPerSecond{0};
    float velocityPerSecond = 0;  ///< rate at which the air assumes the source's velocity; 0: not at all
};

}  // namespace dustbench::grid_fluid::flow
