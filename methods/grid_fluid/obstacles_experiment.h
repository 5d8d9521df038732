// How much of a stream an obstacle swallows, and what of its smoke gets inside (claim R29).
//
// Units: metres, seconds. Threads: the current oneTBB arena; the same at any number of them. Source: Senger2009, 4.1.3.
#pragma once

#include "methods/contract/experiment.h"
#include "methods/grid_fluid/flow/pressure_solver.h"

namespace dustbench::grid_fluid::obstacles {

/// A ball in a stream of 1 m/s with smoke in it, for a second.
struct ObstacleSettings {
    flow::PressureMethod pressure = flow::PressureMethod::multigrid;
    int jacobiSweeps = 6;           ///< as many as the demo takes that the paper goes back to
    float ballMetresPerSecond = 0;  ///< against the stream
    bool isSolid = true;            ///< false: there is nothing where it is
};

/// The worst of all steps.
struct ObstacleReport {
    /// What flows into a surface two cells around the obstacle and not out of it, as a share of what the undisturbed
    /// stream would carry into it.
    double swallowed = 0;
    /// The maximum density within the obstacle, as a share of the maximum around it.
    double smokeInside = 0;
};

[[nodiscard]] ObstacleReport measureObstacleLeakage(const ObstacleSettings& settings);

/// The experiment `obstacles`, with the pressure solved to its tolerance (`_multigrid`) and by the paper's sweeps
/// (`_jacobi`):
///     swallowed_rest_…, swallowed_moving_…    of a ball at rest, and of one that comes towards the stream at half its
///                                             speed
///     smoke_inside                            the maximum of all four
[[nodiscard]] ExperimentInfo describe();

}  // namespace dustbench::grid_fluid::obstacles
