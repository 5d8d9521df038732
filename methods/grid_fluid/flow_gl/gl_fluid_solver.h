// Solves smoke, fire and dust as a flow in a box on the GPU: the same step as flow::FluidSolver, within floating-point
// differences.
//
// The state stays on the GPU; a step reads a few numbers back, once. Results are reproducible on one machine: sums use
// fixed blocks. Units: SI. Frame: world. Owns all fields. Threads: the OpenGL thread's.
// Source: Crane2007, 30.2; Senger2009, 4.1. Departs: see reports/decisions/0007-fluid-on-the-gpu.md.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "methods/grid_fluid/flow/solver.h"
#include "methods/grid_fluid/flow_gl/advection_on_gpu.h"
#include "methods/grid_fluid/flow_gl/density_on_gpu.h"
#include "methods/grid_fluid/flow_gl/forces_on_gpu.h"
#include "methods/grid_fluid/flow_gl/pressure_on_gpu.h"
#include "methods/grid_fluid/flow_gl/solids_on_gpu.h"
#include "methods/kit/gpu/texture.h"

namespace dustbench::grid_fluid::flow_gl {

class GlFluidSolver final : public flow::Solver {
 public:
    /// Throws InputError for an invalid box or settings, or if OpenGL does not accept buffers of that size.
    GlFluidSolver(const flow::FluidSettings& settings, gpu::Device& device, MemoryLedger& ledger);

    void setSolids(const flow::SolidMask& mask) override;
    flow::StepReport step(double stepSeconds, std::span<const flow::FluidSource> sources,
                          const StageClock& clock = StageClock()) override;
    void scroll(glm::ivec3 cells) override;
    [[nodiscard]] std::span<const flow::LeavingDensity> leaving() const override { return leaving_; }
    void addDensity(std::span<const flow::AddedDensity> added) override;

    [[nodiscard]] const flow::FluidBox& box() const override { return settings_.box; }
    [[nodiscard]] std::int64_t steps() const override { return steps_; }
    /// Waits for the GPU, as all functions that read back do.
    [[nodiscard]] std::uint64_t stateHash() const override;
    void gather(flow::Lane lane, std::span<float> to) const override;
    void gatherStored(flow::Lane lane, std::span<float> to) const override;
    [[nodiscard]] std::vector<float> pressuresM2PerS2() const override;
    [[nodiscard]] float divergencePerStep() const override;
    [[nodiscard]] bool onGpu() const override { return true; }
    void gather(flow::Lane lane, const gpu::Texture& to) const override;
    [[nodiscard]] MemoryReport gpuMemory() const override;

    [[nodiscard]] const flow::CellLayout& layout() const { return layout_; }
    /// For setting the state directly.
    void writeCells(const flow::CellField& cells);
    /// All quantities of the cells; ghosts as left by the last kernel (waits for the GPU).
    void readCells(flow::CellField& cells) const;

 private:
    void advect(float stepSeconds);
    void diffuseVelocity(float stepSeconds);
    void project(float stepSeconds);
    void move(const glm::ivec3& by);
    void gatherDivergence() const;
    void gather(flow::Lane lane, bool asStored, std::span<float> to) const;
    void raiseMaximum();
    void requireNumbers();

    flow::FluidSettings settings_;
    flow::CellLayout layout_;
    MemoryLedger& ledger_;
    CellsOnGpu cells_, spare_, guess_;  ///< `spare_`: the next state; `guess_`: first guesses, and the curl
    StepReportOnGpu report_;
    SolidsOnGpu solids_;
    GhostsOnGpu ghosts_;
    AdvectionOnGpu advection_;
    std::optional<DensityOnGpu> density_;
    std::optional<ExchangeOnGpu> exchange_;  ///< exchange of density with the surroundings of the box
    std::vector<flow::LeavingDensity> leaving_;
    SourcesOnGpu sources_;
    ForcesOnGpu forces_;
    PressureOnGpu pressure_;
    Kernel divergence_, gradient_, maximum_, scroll_;
    mutable Kernel gather_, gatherTexture_;  ///< `mutable` because running them sets uniforms
    bool operatorKnown_ = false, speedsKnown_ = false, solidsChanged_ = false, stateUnseen_ = false,
         densityAdded_ = false;
    std::int64_t steps_ = 0;
    double lastStepSeconds_ = 0;
    float advectedSeconds_ = 0;  ///< duration of the flow's last step; 0 if the state was set since
};

}  // namespace dustbench::grid_fluid::flow_gl
