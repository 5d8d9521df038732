// The settings of a fluid, the report of one step, and the interface of the solvers; the same for every backend.
//
// Units: SI. Frame: world.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "methods/contract/stage_clock.h"
#include "methods/grid_fluid/flow/advection.h"
#include "methods/grid_fluid/flow/cell_field.h"
#include "methods/grid_fluid/flow/fluid_box.h"
#include "methods/grid_fluid/flow/fluid_source.h"
#include "methods/grid_fluid/flow/forces.h"
#include "methods/grid_fluid/flow/pressure_solver.h"
#include "methods/grid_fluid/flow/solid_cells.h"
#include "methods/kit/memory/memory_ledger.h"

namespace dustbench::gpu {
class Texture;
}

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

// --- Density that the box passes to its surroundings or receives from them, in cells and summed over cells

/// The density that left the box through a face of an open side in a step.
struct LeavingDensity {
    glm::ivec3 cell;  ///< the cell that it left
    int axis;         ///< of the face
    bool far;         ///< towards +axis
    float cells;      ///< distance that it travelled
    float density;    ///< summed over cells
};

/// The density that a cell receives.
struct AddedDensity {
    glm::ivec3 cell;
    float density;
};

/// Interface of the solvers on the CPU and on the GPU.
class Solver {
 public:
    virtual ~Solver() = default;

    /// Takes effect in the next step. The mask covers the box at its current position.
    virtual void setSolids(const SolidMask& mask) = 0;
    /// Advances by one step. Throws SimulationError with step, field and cell if a value is no longer finite.
    virtual StepReport step(double stepSeconds, std::span<const FluidSource> sources, const StageClock& clock) = 0;
    /// Moves the box by whole cells; cell contents stay in place in the world. The solids must be set again.
    virtual void scroll(glm::ivec3 cells) = 0;
    /// The density that left through open sides in the last step; empty without FluidSettings::notesLeaving. Valid
    /// until the next step.
    [[nodiscard]] virtual std::span<const LeavingDensity> leaving() const { return {}; }
    /// Adds density to distinct cells. The solids must be set again.
    virtual void addDensity(std::span<const AddedDensity> added) = 0;

    [[nodiscard]] virtual const FluidBox& box() const = 0;
    [[nodiscard]] virtual std::int64_t steps() const = 0;
    /// Hash of all records, without ghosts (hashOf).
    [[nodiscard]] virtual std::uint64_t stateHash() const = 0;

    /// Copies one quantity of all cells, x fastest, without ghosts; for a velocity, the mean of the cell's two faces.
    virtual void gather(Lane lane, std::span<float> to) const = 0;
    /// The same as stored: for a velocity, the speed of the face towards −x, −y or −z.
    virtual void gatherStored(Lane lane, std::span<float> to) const = 0;
    /// Kinematic pressure p/ρ of the last step in m²/s², 0 in solids, in the same order.
    [[nodiscard]] virtual std::vector<float> pressuresM2PerS2() const = 0;

    /// Maximum |∇·u|·Δt over the cells by the stored speeds of their faces, with the last step's Δt; 0 before it.
    [[nodiscard]] virtual float divergencePerStep() const = 0;

    /// Whether the state is on the GPU.
    [[nodiscard]] virtual bool onGpu() const = 0;
    /// Copies one quantity of all cells into an R32F texture of the box's size for display: values below 0 become 0.
    /// Only if `onGpu()`.
    virtual void gather(Lane lane, const gpu::Texture& to) const = 0;
    /// Memory on the GPU; the rest is on the ledger.
    [[nodiscard]] virtual MemoryReport gpuMemory() const = 0;
};

}  // namespace dustbench::grid_fluid::flow
