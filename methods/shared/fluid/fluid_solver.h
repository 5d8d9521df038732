// Smoke, fire and dust as a flow in a box: one step of the whole system.
//
// A step carries everything along, adds sources and forces, and makes the flow free of divergence.
// Units: SI. Frame: world. Owns all fields; memory is on the ledger. Threads: one caller; its loops use the current
// arena, and no result depends on how many threads there are. Source: Crane2007, 30.2; Senger2009, 4.1. Departs: see
// reports/decisions/0006-fluid-grid.md.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "methods/shared/fluid/advection.h"
#include "methods/shared/fluid/box_ghosts.h"
#include "methods/shared/fluid/cell_field.h"
#include "methods/shared/fluid/fluid_settings.h"
#include "methods/shared/fluid/fluid_source.h"
#include "methods/shared/fluid/projection.h"
#include "methods/shared/fluid/solid_cells.h"
#include "methods/shared/stage_clock.h"

namespace dustbench::fluid {

class FluidSolver {
 public:
    /// Throws InputError where the box or the settings make no sense, or the machine has not enough memory.
    FluidSolver(const FluidSettings& settings, MemoryLedger& ledger);

    /// From the next step on. The mask covers the box where it stands now.
    void setSolids(const SolidMask& mask);
    /// Advances by a step. Throws SimulationError with step, field and cell where a number gets lost.
    StepReport step(double stepSeconds, std::span<const FluidSource> sources, const StageClock& clock = StageClock());
    /// Moves the box by whole cells; what is in them stays where it is in the world. The solids must be set anew.
    void scroll(glm::ivec3 cells);

    [[nodiscard]] const FluidSettings& settings() const { return settings_; }
    [[nodiscard]] const CellLayout& layout() const { return layout_; }
    [[nodiscard]] const FluidBox& box() const { return settings_.box; }
    [[nodiscard]] const CellField& cells() const { return cells_; }
    /// To set the state by hand.
    [[nodiscard]] CellField& changeCells() {
        speedsKnown_ = false;
        return cells_;
    }
    [[nodiscard]] const SolidCells& solids() const { return solids_; }
    /// Kinematic pressure p/ρ of the last step in m²/s², 0 in solids.
    [[nodiscard]] float pressureM2PerS2(int i, int j, int k) const;
    [[nodiscard]] std::int64_t steps() const { return steps_; }
    /// Of all records, the same whatever the number of threads.
    [[nodiscard]] std::uint64_t stateHash() const;

 private:
    void addSources(std::span<const FluidSource> sources, float stepSeconds);
    void diffuseVelocity(float stepSeconds);
    void advect(float stepSeconds);
    PressureResult project(float stepSeconds);
    void findGreatestSpeeds();
    [[nodiscard]] std::size_t floatsToLend() const;
    [[nodiscard]] std::span<float> borrowed() { return {spare_.data(), spare_.floats()}; }
    void fill(GhostUse use);

    FluidSettings settings_;
    CellLayout layout_;
    PressureSolver pressure_;
    CellField cells_, spare_;  ///< `spare_`: the state before; between, memory for forces and pressure
    SolidCells solids_;
    Advection advection_;
    Projection projection_;
    glm::vec3 greatestSpeeds_{0};
    bool speedsKnown_ = false;
    double covered_ = 0;  ///< density that solids covered since the last step
    std::int64_t steps_ = 0;
    double lastStepSeconds_ = 0;
};

}  // namespace dustbench::fluid
