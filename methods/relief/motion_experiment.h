// How far a particle is from its parabola after one second under both laws of motion (particles/relief_motion.h).
//
// The paper prints P = P₀ + V₀·T + ½·g·T² and V = V₀·T + g·T, with T the age in steps, and rewrites P₀ and V₀ in each
// step. A thousand particles with random velocities of up to 1 m/s along each axis fall for one second under 9.8 m/s²,
// in 1, 4, 8 or 12 steps (after 34 the paper's velocities exceed floats), and in 60 steps of the corrected law.
//
// Findings, medians over the particles in m; intervals are over seven seeds:
//     distance_paper_STEPS       from the exact parabola, as printed
//     distance_fixed_STEPS       with V₀ + g·Δt, and T as the time step
//     distance_first_order_60    with P₀ + V₀·Δt, a control: it falls short by ½·g·Δt
//     distance_without_gravity   of a straight line, a control: ½·g
//
// Threads: one. Source: Bergeron, 3.2.
#pragma once

#include "methods/contract/experiment.h"

namespace dustbench::relief::motion {

[[nodiscard]] ExperimentInfo describe();

}  // namespace dustbench::relief::motion
