// The settings of a fluid, and the report of one step; the same for every backend.
//
// Units: SI. Frame: world.
#pragma once

#include "methods/grid_fluid/flow/advection.h"
#include "methods/grid_fluid/flow/fluid_box.h"
#include "methods/grid_fluid/flow/forces.h"
#include "methods/grid_fluid/flow/pressure_solver.h"

namespace dustbench::grid_fluid::flow {

struct FluidSettings {
    FluidBox box;
    Sides sides = openOverFloor;
    glm::vec3 windMetresPerSecond{0};  ///< enters at inflow sides, and is the initial velocity everywhere
    bool noSlip = false;               ///< solids and walls hold the air; otherwise it slides along them
    AdvectionRule advection;
    /// Removes density created by advection, in proportion everywhere, and restores density lost by advection or
    /// covered by solids.
    bool keepsDensity = false;
    bool notesLeaving = false;  ///< records density that leaves through open sides, for Solver::leaving
    ForceSettings forces;
    PressureMethod pressure = PressureMethod::multigrid;
    int jacobiSweeps = 20;
    int maximumCycles = 30;
    /// Multigrid stops when |∇·u|·Δt, the relative volume gain of a cell in a step, is at most this everywhere.
    float divergencePerStep = 0.001f;
};

/// The results of a step.
struct StepReport {
    PressureResult pressure;      ///< in metres per second
    float divergencePerStep = 0;  ///< maximum of |∇·u|·Δt over all cells, after the pressure solver
    float cellsPerStep = 0;       ///< maximum speed along an axis, in cells per step: the CFL number
};

/// Throws InputError for an invalid box or invalid settings.
void check(const FluidSettings& settings);
/// The same for a step, which must be longer than 0.
void checkStep(double stepSeconds);
/// The number of explicit steps into which viscosity divides one step. Throws InputError if there are too many.
[[nodiscard]] int diffusionParts(const FluidSettings& settings, float stepSeconds);

/// Hash of all records of a state, without ghosts.
[[nodiscard]] std::uint64_t hashOf(const CellField& cells, const CellLayout& layout);
/// Throws with the quantity that is no longer finite, the number of steps and the cell.
[[noreturn]] void throwLostNumber(const CellField& cells, const CellLayout& layout, std::int64_t steps);

}  // namespace dustbench::grid_fluid::flow
