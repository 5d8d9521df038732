// How a fluid behaves, and what one step of it came to; the same for every backend.
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
    glm::vec3 windMetresPerSecond{0};  ///< blows in where a side is an inflow, and everywhere at first
    bool noSlip = false;               ///< solids and walls hold the air; else it glides along them
    AdvectionRule advection;
    /// Takes off, everywhere in proportion, what advection makes of nothing, and gives back what it loses and what
    /// solids cover.
    bool keepsDensity = false;
    ForceSettings forces;
    PressureMethod pressure = PressureMethod::multigrid;
    int jacobiSweeps = 20;
    int maximumCycles = 30;
    /// Multigrid stops where |∇·u|·Δt, the share of its volume that a cell gains in a step, is nowhere greater.
    float divergencePerStep = 0.001f;
};

/// What a step came to.
struct StepReport {
    PressureResult pressure;      ///< in metres per second
    float divergencePerStep = 0;  ///< |∇·u|·Δt, the maximum of all cells, as the pressure solver leaves it
    float cellsPerStep = 0;       ///< the maximum speed along an axis, in cells: the CFL number
};

/// Throws InputError where the box or the settings make no sense.
void check(const FluidSettings& settings);
/// The same for a step: it must be longer than 0.
void checkStep(double stepSeconds);
/// Into how many explicit steps viscosity divides one. Throws InputError where they are too many.
[[nodiscard]] int diffusionParts(const FluidSettings& settings, float stepSeconds);

/// Of all records of a state, ghosts aside.
[[nodiscard]] std::uint64_t hashOf(const CellField& cells, const CellLayout& layout);
/// Says which number of a state got lost, after how many steps, and where.
[[noreturn]] void throwLostNumber(const CellField& cells, const CellLayout& layout, std::int64_t steps);

}  // namespace dustbench::grid_fluid::flow
