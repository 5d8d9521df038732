// Over-relaxation factors for the pressure's sweeps and coarse corrections; the same for every backend.
//
// A sweep solves red cells, then black cells. Seen from the black cells only, this is a step of Richardson's method: an
// error wave with Jacobi factor μ is multiplied by 1 − ω(1 − μ²) if the black half-sweep steps ω times as far. Coarse
// grids handle μ² > 4/9; of the rest, three equal sweeps leave up to (4/9)³ = 0.09, and the three factors here 0.02.
// Red cells never over-relax, so their previous values have no influence; nor do black cells in the last sweep before a
// residual is taken, which then vanishes there.
//
// Source: Yavneh1996 (over-relaxed red-black sweeps in three dimensions). Departs: a factor per sweep, for black cells
// only.
#pragma once

#include <array>

namespace dustbench::grid_fluid::flow {

/// Before and after each coarse correction.
inline constexpr std::array relaxationsBefore{1.6f, 1.0f};
inline constexpr std::array relaxationsAfter{1.2f};

/// Factor on the coarse solution. Restriction and interpolation lose part of the components that are no longer smooth
/// there; a factor above 1 recovers it at the cost of overcorrecting the smoothest ones. Of 1, 1.05, … 1.2, this value
/// leaves the smallest remainder of both.
inline constexpr float overcorrection = 1.1f;

}  // namespace dustbench::grid_fluid::flow
