// By how much the pressure's sweeps and coarse corrections overstep, the same for every backend.
//
// A sweep solves red cells and then black ones. For the black ones alone that is a step of Richardson's method: what
// errs as a wave with Jacobi factor μ is left as 1 − ω(1 − μ²) of itself where the black half steps ω times as far as
// it would. Coarse grids see to μ² > 4/9; on the rest three sweeps alike leave up to (4/9)³ = 0.09, and the three
// factors here 0.02. Red cells never overstep, so that nothing of what they held before counts; nor do black ones in
// the last sweep before a residual is taken, which then have none.
//
// Source: Yavneh1996 (over-relaxed red-black sweeps in three dimensions). Departs: a factor for each sweep, for black
// cells alone.
#pragma once

#include <array>

namespace dustbench::grid_fluid::flow {

/// On either side of each coarse correction.
inline constexpr std::array relaxationsBefore{1.6f, 1.0f};
inline constexpr std::array relaxationsAfter{1.2f};

/// So many times the coarse solution is added. Going down and up leaves out part of what is no longer smooth there; a
/// little too much of the smoothest is what that costs, and of 1, 1.05, … 1.2 this leaves the minimum of both.
inline constexpr float overcorrection = 1.1f;

}  // namespace dustbench::grid_fluid::flow
