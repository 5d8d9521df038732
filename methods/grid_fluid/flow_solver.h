// The solver of a fluid, on the CPU or on the GPU, as the method uses it.
//
// Units: SI. Frame: world. Threads: the OpenGL thread's.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "methods/shared/fluid/fluid_solver.h"
#include "methods/shared/fluid_gl/gl_fluid_solver.h"

namespace dustbench::grid_fluid {

enum class SolverBackend {
    automatic,  ///< the GPU where OpenGL has one, and the picture is made there as well
    cpu,
    openGl,
};

class FlowSolver {
 public:
    FlowSolver(const fluid::FluidSettings& settings, bool onGpu, gpu::Device& device, MemoryLedger& ledger);

    void setSolids(const fluid::SolidMask& mask);
    fluid::StepReport step(double stepSeconds, std::span<const fluid::FluidSource> sources, const StageClock& clock);
    void scroll(glm::ivec3 cells);

    [[nodiscard]] bool onGpu() const { return gl_.has_value(); }
    [[nodiscard]] const fluid::FluidBox& box() const { return gl_ ? gl_->box() : cpu_->box(); }
    [[nodiscard]] std::int64_t steps() const { return gl_ ? gl_->steps() : cpu_->steps(); }
    /// One of the numbers that cells hold, x fastest, without ghosts.
    void gather(fluid::Lane lane, std::span<float> to) const;
    /// The same into a texture of the box's cells; only `onGpu()`.
    void gather(fluid::Lane lane, const gpu::Texture& to) const { gl_->gather(lane, to); }
    [[nodiscard]] std::vector<float> pressuresM2PerS2() const;
    [[nodiscard]] std::uint64_t stateHash() const { return gl_ ? gl_->stateHash() : cpu_->stateHash(); }
    /// What lies on the GPU; the rest is on the ledger.
    [[nodiscard]] MemoryReport gpuMemory() const { return gl_ ? gl_->memory() : MemoryReport(); }

 private:
    std::optional<fluid::FluidSolver> cpu_;  ///< one of these two
    std::optional<fluid_gl::GlFluidSolver> gl_;
};

}  // namespace dustbench::grid_fluid
