// Plain advection of whole fields in double precision; the reference implementation of Advection.
//
//     x₋ = x − Δt·u(x − ½Δt·u(x))        departure point of a cell
//     φ̂(x) = φ(x₋)                        the first guess, and the result of the semi-Lagrangian scheme
//     x₊ = x₋ + 2Δt·u(x)                  the path ahead, mirrored
//     u = uⁿ + a·(uⁿ − uⁿ⁻¹)              if paths follow the velocity at the middle of the step
//     φ(x) ← φ̂(x) + ½(φ(x) − φ̂(x₊))      corrected, within the extrema of the eight cells around x₋
//
// Units: cells, metres per second. Source: Stam1999, 2.2; Selle2008, Eq. 4 and 3.2. Departs: as Advection does.
#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "methods/grid_fluid/flow/advection.h"

namespace dustbench::grid_fluid::flow {

using PlainRecord = std::array<double, lanes>;

/// Velocities at the centres of all padded cells; beyond the box those of the outermost cells.
[[nodiscard]] std::vector<glm::dvec3> plainCentres(const CellField& cells, const CellLayout& layout);

/// For VelocityAt::middle.
struct PlainExtrapolation {
    std::vector<glm::dvec3> last;  ///< plainCentres of the last step
    double ahead;
    glm::dvec3 maximumSpeeds;
};

/// The records of all padded cells after `cellsPerSpeed` = Δt/h; cells that are not fluid are unchanged. Parameters as
/// in Advection::advect.
[[nodiscard]] std::vector<PlainRecord> plainAdvection(const CellField& from, const CellLayout& layout,
                                                      const Moving* moving, AdvectionRule rule, double cellsPerSpeed,
                                                      double maximumSpeedZ,
                                                      const PlainExtrapolation* extrapolation = nullptr);

}  // namespace dustbench::grid_fluid::flow
