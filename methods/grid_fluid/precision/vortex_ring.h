// The flow around a vortex ring, as an initial flow.
//
// Its vector potential is that of a thin ring whose kernel is softened by the core's radius; the speed of a face is the
// circulation of the potential around it, so the flow is divergence-free except for rounding.
// Units: m, m/s, m²/s. Threads: rows in blocks. Source: Rosenhead1930 (the softened kernel).
#pragma once

#include "methods/grid_fluid/flow/fluid_box.h"
#include "methods/grid_fluid/precision/staggered_flow.h"

namespace dustbench::grid_fluid::precision {

/// It moves towards +x.
struct VortexRing {
    glm::dvec3 centreMetres{0};
    double radiusMetres = 1;
    double coreMetres = 0.1;
    double circulationM2PerSecond = 1;

    /// Radius to the centre of the core.
    [[nodiscard]] double distanceMetres(const glm::dvec3& place) const;
};

/// Sets the speeds of all faces and ignores walls.
void addRing(const VortexRing& ring, const flow::FluidBox& box, StaggeredFlow& flow);

}  // namespace dustbench::grid_fluid::precision
