// The fluid of the published demo by OpenGL, in its fields: 32 bytes per cell for the flow and 9 for the solids.
//
// The same step as DemoSolver's, to half precision. Units: SI. Frame: world. Owns all fields; their bytes are on
// the device's ledger. Threads: the OpenGL thread's. Source: Crane2007, 30.2; Senger2009, 4.1 and table 1.
#pragma once

#include <array>

#include "methods/grid_fluid/demo/demo_solver.h"
#include "methods/grid_fluid/flow/solver.h"
#include "methods/grid_fluid/flow_gl/kernel.h"
#include "methods/kit/gpu/buffer.h"
#include "methods/kit/gpu/texture.h"

namespace dustbench::grid_fluid::demo {

class GlDemoSolver final : public flow::Solver {
 public:
    GlDemoSolver(const DemoSettings& settings, gpu::Device& device);

    void setSolids(const flow::SolidMask& mask) override;
    flow::StepReport step(double stepSeconds, std::span<const flow::FluidSource> sources,
                          const StageClock& clock = StageClock()) override;
    /// Always throws: the demo's box cannot move.
    void scroll(glm::ivec3 cells) override;
    [[nodiscard]] const flow::FluidBox& box() const override { return settings_.box; }
    [[nodiscard]] std::int64_t steps() const override { return steps_; }
    [[nodiscard]] std::uint64_t stateHash() const override;
    void gather(flow::Lane lane, std::span<float> to) const override;
    void gatherStored(flow::Lane lane, std::span<float> to) const override { gather(lane, to); }
    [[nodiscard]] std::vector<float> pressuresM2PerS2() const override;
    [[nodiscard]] float divergencePerStep() const override;
    [[nodiscard]] bool onGpu() const override { return true; }
    void gather(flow::Lane lane, const gpu::Texture& to) const override;
    void addDensity(std::span<const flow::AddedDensity> added) override;
    [[nodiscard]] MemoryReport gpuMemory() const override;

 private:
    using Report = std::array<std::uint32_t, 6>;  ///< as bits: speeds, divergence, density, temperature
    using Kernel = flow_gl::Kernel;
    struct Advection {
        Kernel guess, correct;
    };
    void advect(Advection& by, const gpu::Texture& field, const gpu::Texture& guess, const gpu::Texture& result,
                float cellsPerSpeed, float kept);
    void addSource(const flow::FluidSource& source, float seconds);
    void applyForces(float seconds);
    void project();
    [[nodiscard]] Report read() const;
    void run(const Kernel& kernel) const { kernel.run(settings_.box.cells); }

    DemoSettings settings_;
    gpu::Texture velocity_, otherVelocity_, vector_, density_, temperature_, pressure_, scalar_, solidVelocity_,
        solids_;
    mutable gpu::Buffer report_;  ///< `mutable` because computing it clears it
    Advection vectors_, scalars_;
    Kernel source_, curl_, forces_, divergence_, jacobi_, project_, findReport_;
    mutable Kernel shown_;  ///< `mutable` because running it sets a uniform
    std::int64_t steps_ = 0;
    double lastStepSeconds_ = 0;
};

}  // namespace dustbench::grid_fluid::demo
