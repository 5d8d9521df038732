// Interface of the fluid solvers on the CPU and on the GPU.
//
// Units: SI. Frame: world.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "methods/contract/stage_clock.h"
#include "methods/grid_fluid/flow/cell_field.h"
#include "methods/grid_fluid/flow/exchanged_density.h"
#include "methods/grid_fluid/flow/fluid_settings.h"
#include "methods/grid_fluid/flow/fluid_source.h"
#include "methods/grid_fluid/flow/solid_mask.h"
#include "methods/kit/memory/memory_ledger.h"

namespace dustbench::gpu {
class Texture;
}

namespace dustbench::grid_fluid::flow {

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
