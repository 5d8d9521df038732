// Measures how much of a stream an obstacle swallows, and how much of its smoke gets inside (claim R29).
//
// Units: metres, seconds. Threads: the current oneTBB arena; the same at any number of them. Source: Senger2009, 4.1.3.
#pragma once

#include "methods/contract/experiment.h"
#include "methods/grid_fluid/flow/pressure_solver.h"

namespace dustbench::grid_fluid::obstacles {

/// A ball in a stream of 1 m/s with smoke, for one second.
struct ObstacleSettings {
    flow::PressureMethod pressure = flow::PressureMethod::multigrid;
    int jacobiSweeps = 6;           ///< as in the demo on which the paper is based
    float ballMetresPerSecond = 0;  ///< against the stream
    bool isSolid = true;            ///< false: no obstacle
};

/// Maxima over all steps.
struct ObstacleReport {
    /// Net inflow through a surface two cells around the obstacle, relative to the inflow of the undisturbed stream.
    double swallowed = 0;
    /// The maximum density within the obstacle, relative to the maximum around it.
    double smokeInside = 0;
};

[[nodiscard]] ObstacleReport measureObstacleLeakage(const ObstacleSettings& settings);

/// The experiment `obstacles`, with the pressure solved to its tolerance (`_multigrid`) and by the paper's sweeps
/// (`_jacobi`):
///     swallowed_rest_…, swallowed_moving_…    of a ball at rest, and of one that moves against the stream at half its
///                                             speed
///     smoke_inside                            the maximum of all four
[[nodiscard]] ExperimentInfo describe();

}  // namespace dustbench::grid_fluid::obstacles
