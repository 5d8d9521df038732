// Measures whether a flow stays bounded and keeps moving in steps of many cells (claim R28).
//
// Units: metres, seconds. Threads: the current oneTBB arena; results do not depend on their number.
// Source: Senger2009, 4.1.1.
#pragma once

#include <string>

#include "methods/contract/experiment.h"
#include "methods/grid_fluid/flow/advection.h"

namespace dustbench::grid_fluid::large_steps {

/// A jet has blown for a third of a second in a closed box; then the flow evolves freely for the time in which its
/// maximum speed crosses 80 cells.
struct StepSettings {
    flow::AdvectionRule advection{flow::AdvectionScheme::semiLagrangian, flow::Limit::none};
    double cellsPerStep = 0.5;  ///< CFL number of the maximum speed at the beginning
    bool isFrozen = false;      ///< the flow never changes
};

/// Relative to the beginning, over all steps.
struct StepReport {
    double speed = 0;         ///< maximum speed of a face
    double energy = 0;        ///< maximum kinetic energy
    double energyLeft = 0;    ///< kinetic energy at the end
    double travelMetres = 0;  ///< of the kinetic energy's centre, along the jet
    std::string lost;         ///< reason for an early end: a value was no longer finite
};

[[nodiscard]] StepReport measureSteps(const StepSettings& settings);

/// The experiment `large_steps`, with semi-Lagrangian advection at CFL numbers N = 0.5, 1, 2, 5, 10, 20:
///     speed_N, energy_N, energy_left_N    as in StepReport
///     travel_N                            relative to that at 0.5
///     speed_unlimited, energy_unlimited   at 20, with MacCormack without a limit
///     travel_frozen                       for a flow that never changes
[[nodiscard]] ExperimentInfo describe();

}  // namespace dustbench::grid_fluid::large_steps
