// The distance of a flow from a reference on the same cells, and invariants of a flow.
//
// A flow on a finer grid is averaged first, the density over cells and the speeds over faces, which preserves the flow
// through the coarse faces. Units: SI. Threads: pure.
#pragma once

#include <cstdint>
#include <span>

#include "methods/grid_fluid/precision/staggered_flow.h"

namespace dustbench::grid_fluid::precision {

/// Means over `refinement`³ cells and `refinement`² faces.
[[nodiscard]] StaggeredFlow averaged(const StaggeredFlow& flow, int refinement);

struct FlowDistance {
    double density = 0;    ///< ‖a − b‖ / ‖b‖ over cells
    double velocity = 0;   ///< the same for speeds over faces
    double enstrophy = 0;  ///< |ln(Σω²(a) / Σω²(b))|, ω of the edges between the cells
    /// Root mean square of ln(E(a) / E(b)) over the wave numbers 1, 2, … of the velocity's cosine series, in half waves
    /// per width along z, up to the finest that the cells hold.
    double spectrum = 0;
};
[[nodiscard]] FlowDistance distanceOf(const StaggeredFlow& flow, const StaggeredFlow& reference);

/// Conserved or bounded quantities.
struct FlowSums {
    double massM3 = 0;             ///< Σ density·volume
    double energyM5PerS2 = 0;      ///< Σ u²/2·volume over faces
    double divergencePerStep = 0;  ///< maximum of |∇·u|·Δt over cells that are not solid
};
[[nodiscard]] FlowSums sumsOf(const StaggeredFlow& flow, std::span<const std::uint8_t> solids, double spacingMetres,
                              double stepSeconds);

}  // namespace dustbench::grid_fluid::precision
