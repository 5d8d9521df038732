// Solves smoke, fire and dust as a flow in a box, step by step.
//
// A step advects all quantities, adds sources and forces, and makes the flow divergence-free.
// Units: SI. Frame: world. Owns all fields; memory is on the ledger. Threads: one caller; its loops use the current
// arena, and results do not depend on the number of threads. Source: Crane2007, 30.2; Senger2009, 4.1. Departs: see
// reports/decisions/0006-fluid-grid.md.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "methods/grid_fluid/flow/advection.h"
#include "methods/grid_fluid/flow/box_ghosts.h"
#include "methods/grid_fluid/flow/field_survey.h"
#include "methods/grid_fluid/flow/projection.h"
#include "methods/grid_fluid/flow/solid_cells.h"
#include "methods/grid_fluid/flow/solver.h"

namespace dustbench::grid_fluid::flow {

class FluidSolver final : public Solver {
 public:
    /// Throws InputError for an invalid box or settings, or if there is not enough memory.
    FluidSolver(const FluidSettings& settings, MemoryLedger& ledger);

    void setSolids(const SolidMask& mask) override;
    StepReport step(double stepSeconds, std::span<const FluidSource> sources,
                    const StageClock& clock = StageClock()) override;
    void scroll(glm::ivec3 cells) override;
    [[nodiscard]] std::span<const LeavingDensity> leaving() const override { return leaving_; }
    void addDensity(std::span<const AddedDensity> added) override;

    [[nodiscard]] const FluidBox& box() const override { return settings_.box; }
    [[nodiscard]] std::int64_t steps() const override { return steps_; }
    [[nodiscard]] std::uint64_t stateHash() const override;
    void gather(Lane lane, std::span<float> to) const override;
    void gatherStored(Lane lane, std::span<float> to) const override;
    [[nodiscard]] std::vector<float> pressuresM2PerS2() const override;
    [[nodiscard]] bool onGpu() const override { return false; }
    void gather(Lane lane, const gpu::Texture& to) const override;
    [[nodiscard]] MemoryReport gpuMemory() const override { return {}; }

    [[nodiscard]] const CellLayout& layout() const { return layout_; }
    [[nodiscard]] const CellField& cells() const { return cells_; }
    /// For setting the state directly.
    [[nodiscard]] CellField& changeCells() {
        speedsKnown_ = false;
        advectedSeconds_ = 0;
        return cells_;
    }
    [[nodiscard]] const SolidCells& solids() const { return solids_; }
    /// Maximum |∇·u|·Δt of the stored faces, with the last step's Δt; 0 before the first.
    [[nodiscard]] float divergencePerStep() const override;

 private:
    void gatherMean(Lane lane, std::size_t next, std::span<float> to) const;
    void addSources(std::span<const FluidSource> sources, float stepSeconds);
    void diffuseVelocity(float stepSeconds);
    void advect(float stepSeconds);
    PressureResult project(float stepSeconds);
    void findMaximumSpeeds();
    /// Stores the maximum speeds. Throws InputError if a value of the state is not finite.
    void note(const FieldSurvey& survey);
    [[nodiscard]] std::size_t floatsToLend() const;
    [[nodiscard]] std::span<float> borrowed() { return {spare_.data(), spare_.floats()}; }
    [[nodiscard]] GhostRule ghostRule() const {
        return {settings_.sides, settings_.windMetresPerSecond, settings_.noSlip};
    }
    void fillGhosts() { flow::fillGhosts(cells_, layout_, ghostRule()); }

    FluidSettings settings_;
    CellLayout layout_;
    PressureSolver pressure_;
    CellField cells_, spare_;  ///< `spare_`: the previous state; between steps, memory for forces and pressure
    SolidCells solids_;
    bool sameSolids_ = false;  ///< solids are the same as in the last projection
    Advection advection_;
    glm::vec3 maximumSpeeds_{0};
    bool speedsKnown_ = false;
    double covered_ = 0;  ///< density covered by solids since the last step
    std::vector<LeavingDensity> leaving_;
    std::int64_t steps_ = 0;
    double lastStepSeconds_ = 0;
    float advectedSeconds_ = 0;  ///< duration of the flow's last step; 0 if the state was set since
};

}  // namespace dustbench::grid_fluid::flow
