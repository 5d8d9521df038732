// Smoke, fire and dust as a flow in a box, on the GPU: the same step as fluid::FluidSolver, within what floats differ
// by.
//
// The state stays on the GPU; a step reads a few numbers back, once. Results are the same from run to run on one
// machine: sums go over fixed blocks. Units: SI. Frame: world. Owns all fields. Threads: the OpenGL thread's.
// Source: Crane2007, 30.2; Senger2009, 4.1. Departs: see reports/decisions/0007-fluid-on-the-gpu.md.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "methods/shared/fluid/fluid_settings.h"
#include "methods/shared/fluid_gl/advection_on_gpu.h"
#include "methods/shared/fluid_gl/density_on_gpu.h"
#include "methods/shared/fluid_gl/forces_on_gpu.h"
#include "methods/shared/fluid_gl/ghosts_on_gpu.h"
#include "methods/shared/fluid_gl/pressure_on_gpu.h"
#include "methods/shared/fluid_gl/solids_on_gpu.h"
#include "methods/shared/fluid_gl/sources_on_gpu.h"
#include "methods/shared/gpu/texture.h"
#include "methods/shared/stage_clock.h"

namespace dustbench::fluid_gl {

class GlFluidSolver {
 public:
    /// Throws InputError where the box or the settings make no sense, or OpenGL takes no buffers of that size.
    GlFluidSolver(const fluid::FluidSettings& settings, gpu::Device& device, MemoryLedger& ledger);

    /// From the next step on. The mask covers the box where it stands now.
    void setSolids(const fluid::SolidMask& mask);
    /// Advances by a step. Throws SimulationError with step, field and cell where a number gets lost.
    fluid::StepReport step(double stepSeconds, std::span<const fluid::FluidSource> sources,
                           const StageClock& clock = StageClock());
    /// Moves the box by whole cells; what is in them stays where it is in the world. The solids must be set anew.
    void scroll(glm::ivec3 cells);

    [[nodiscard]] const fluid::FluidSettings& settings() const { return settings_; }
    [[nodiscard]] const fluid::CellLayout& layout() const { return layout_; }
    [[nodiscard]] const fluid::FluidBox& box() const { return settings_.box; }
    [[nodiscard]] std::int64_t steps() const { return steps_; }

    /// To set the state by hand.
    void writeCells(const fluid::CellField& cells);
    /// All that cells hold; ghosts as the last kernel left them (waits for the GPU).
    void readCells(fluid::CellField& cells) const;
    /// Kinematic pressure p/ρ of the last step in m²/s², 0 in solids; x fastest, without ghosts.
    [[nodiscard]] std::vector<float> pressuresM2PerS2() const;
    /// Of all records, as fluid::FluidSolver::stateHash has it.
    [[nodiscard]] std::uint64_t stateHash() const;
    /// One of the numbers that cells hold, x fastest, without ghosts (waits for the GPU).
    void gather(fluid::Lane lane, std::span<float> to) const;
    /// The same into an R32F texture of the box's cells, for who draws it there.
    void gather(fluid::Lane lane, const gpu::Texture& to) const;
    [[nodiscard]] MemoryReport memory() const;

 private:
    void advect(float stepSeconds);
    void diffuseVelocity(float stepSeconds);
    void project(float stepSeconds);
    void move(const glm::ivec3& by);
    void findGreatest();
    void requireNumbers();

    fluid::FluidSettings settings_;
    fluid::CellLayout layout_;
    MemoryLedger& ledger_;
    CellsOnGpu cells_, spare_, guess_;  ///< `spare_`: what comes next; `guess_`: first guesses, and the curl
    StepReportOnGpu report_;
    SolidsOnGpu solids_;
    GhostsOnGpu ghosts_;
    AdvectionOnGpu advection_;
    std::optional<DensityOnGpu> density_;
    SourcesOnGpu sources_;
    ForcesOnGpu forces_;
    PressureOnGpu pressure_;
    Kernel divergence_, gradient_, greatest_, scroll_;
    mutable Kernel gather_, gatherTexture_;  ///< they change nothing here but their own uniforms
    bool operatorKnown_ = false, speedsKnown_ = false, stateUnseen_ = false;
    std::int64_t steps_ = 0;
    double lastStepSeconds_ = 0;
};

}  // namespace dustbench::fluid_gl
