// Solves for the pressure on the GPU as flow::PressureSolver does: multigrid down to a residual, or Jacobi sweeps.
//
// The operator is built when solids change. Cycles are queued without checking convergence; the caller reads the report
// and requests more if necessary. Units: see flow/projection.h. Owns its buffers. Threads: the OpenGL thread's.
// Source: Trottenberg2001, 2.4 and 2.8; Crane2007, 30.2.3 (Jacobi).
// Departs: coarsest levels have at most 32 cells, not 64: their inverse is built by one group of threads.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "methods/grid_fluid/flow/fluid_box.h"
#include "methods/grid_fluid/flow/pressure_solver.h"
#include "methods/grid_fluid/flow_gl/cells_on_gpu.h"
#include "methods/grid_fluid/flow_gl/kernel.h"
#include "methods/kit/gpu/buffer.h"

namespace dustbench::grid_fluid::flow_gl {

class PressureOnGpu {
 public:
    PressureOnGpu(gpu::Device& device, const glm::ivec3& cells, const flow::Sides& sides, flow::PressureMethod method);

    /// `kinds`: the kinds of cells (kinds.glsl). `closed`: their closed regions.
    void build(const gpu::Buffer& kinds, const std::vector<std::vector<flow::Run>>& closed);

    /// Queues a whole solution, with as many cycles as the last one needed. `rightSide()` must be filled in.
    void start(const flow::PressureRule& rule, StepReportOnGpu& report);
    /// False if the report, which must have been read, shows too large a residual; then one more cycle is queued.
    [[nodiscard]] bool enough(StepReportOnGpu& report);
    [[nodiscard]] const flow::PressureResult& result() const { return result_; }

    [[nodiscard]] const gpu::Buffer& rightSide() const { return levels_.front().rightSide; }
    [[nodiscard]] const gpu::Buffer& pressure() const { return levels_.front().pressure; }
    /// The pressure of all cells, x fastest, without ghosts (waits for the GPU).
    [[nodiscard]] std::vector<float> readPressure() const;
    [[nodiscard]] std::size_t bytes() const;

 private:
    struct Level {
        glm::ivec3 cells{0};
        gpu::Buffer pressure, rightSide;
        gpu::Buffer operation;  ///< sums of weights; on coarser levels also weights of faces
        gpu::Buffer wide;       ///< coarser levels: the pressure padded for interpolation
    };
    /// Programs for the finest level and for the others.
    struct Pair {
        Kernel finest, coarser;
        Kernel& of(std::size_t level) { return level == 0 ? finest : coarser; }
    };

    void addLevel(gpu::Device& device, const glm::ivec3& cells);
    void bind(const Level& level) const;
    void smooth(std::size_t level, std::span<const float> relaxations);
    void restrictFrom(std::size_t level, int slot);
    void correctFrom(std::size_t coarse);
    void cycle(std::size_t level);
    void solveCoarsest();
    void queueCycle();
    void balanceClosedRegions();
    void sweepJacobi();

    flow::PressureRule rule_;
    std::vector<Level> levels_;
    gpu::Buffer other_;  ///< Jacobi's second field
    gpu::Buffer inverse_, runs_, regions_;
    int regionCount_ = 0;
    Kernel diagonal_;
    Pair coarsen_, sweep_, restrict_, prolong_;
    Kernel residual_, widen_, invert_, solve_, closed_;
    int expectedCycles_ = 3, cycles_ = 0;
    flow::PressureResult result_;
    gpu::Device& device_;
};

}  // namespace dustbench::grid_fluid::flow_gl
