// Smoke, fire and dust as a flow in a box: one step of the whole system.
//
// A step carries everything along, adds sources and forces, and makes the flow free of divergence.
// Units: SI. Frame: world. Owns all fields; memory is on the ledger. Threads: one caller; its loops use the current
// arena, and no result depends on how many threads there are. Source: Crane2007, 30.2; Senger2009, 4.1. Departs: see
// reports/decisions/0006-fluid-grid.md.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "methods/shared/fluid/advection.h"
#include "methods/shared/fluid/box_ghosts.h"
#include "methods/shared/fluid/cell_field.h"
#include "methods/shared/fluid/fluid_box.h"
#include "methods/shared/fluid/fluid_source.h"
#include "methods/shared/fluid/forces.h"
#include "methods/shared/fluid/pressure_solver.h"
#include "methods/shared/fluid/projection.h"
#include "methods/shared/fluid/solid_cells.h"
#include "methods/shared/stage_clock.h"

namespace dustbench::fluid {

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
    int mostCycles = 30;
    /// Multigrid stops where |∇·u|·Δt, the share of its volume that a cell gains in a step, is nowhere greater.
    float divergencePerStep = 0.001f;
};

/// What a step came to.
struct StepReport {
    PressureResult pressure;      ///< in metres per second
    float divergencePerStep = 0;  ///< |∇·u|·Δt, the greatest of all cells, as the pressure solver leaves it
    float cellsPerStep = 0;       ///< the greatest speed along an axis, in cells: the CFL number
};

class FluidSolver {
 public:
    /// Throws InputError where the box or the settings make no sense, or the machine has not enough memory.
    FluidSolver(const FluidSettings& settings, MemoryLedger& ledger);

    /// From the next step on. The mask covers the box where it stands now.
    void setSolids(const SolidMask& mask);
    /// Advances by a step. Throws std::runtime_error with step, field and cell where a number gets lost.
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
    void checkSettings() const;
    void addSources(std::span<const FluidSource> sources, float stepSeconds);
    void diffuseVelocity(float stepSeconds);
    void advect(float stepSeconds);
    PressureResult project(float stepSeconds);
    void findGreatestSpeeds();
    [[noreturn]] void throwLostNumber() const;
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
