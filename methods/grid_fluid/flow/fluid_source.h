// A source of smoke, heat, fuel and motion: a ball with a soft edge, and the cells that it affects.
//
// Units: metres, seconds; cells where stated. Frame: world. Threads: pure. Source: Senger2009, 4.3 (a Gaussian, times a
// function of time). Departs: strengths are per second; the caller varies them with time.
#pragma once

#include <glm/glm.hpp>

#include "methods/grid_fluid/flow/fluid_box.h"

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

/// The cells affected by a source, and its contribution to them in a step; the same for every backend.
struct SourceReach {
    glm::dvec3 centreCells{0};  ///< the centre of cell (0, 0, 0) is at 0
    float perRadius = 1;        ///< inverse radius; the radius is at least half a cell
    glm::ivec3 first{0}, last{-1};

    [[nodiscard]] bool empty() const { return first.x > last.x || first.y > last.y || first.z > last.z; }
};

/// Throws InputError for a source without a radius.
[[nodiscard]] SourceReach reachOf(const FluidSource& source, const FluidBox& box);

}  // namespace dustbench::grid_fluid::flow
