// Advects all quantities of the cells on the GPU, as flow::Advection does.
//
// The first guesses have their own field; the centres' velocities, and then the corrections, lie in the spare one.
// Source: Stam1999, 2.2; Selle2008, Eq. 4 and 3.2. Threads: the OpenGL thread's.
#pragma once

#include "methods/grid_fluid/flow/advection.h"
#include "methods/grid_fluid/flow_gl/cells_on_gpu.h"
#include "methods/grid_fluid/flow_gl/kernel.h"
#include "methods/grid_fluid/flow_gl/step_report.h"

namespace dustbench::grid_fluid::flow_gl {

class AdvectionOnGpu {
 public:
    AdvectionOnGpu(gpu::Device& device, const flow::CellLayout& layout, flow::AdvectionRule rule);

    /// Advects `cells`, with ghosts filled, by `cellsPerSpeed` = Δt/h; `spare` and `guess` are temporary. The report
    /// must contain the maximum speeds.
    void advect(CellsOnGpu& cells, CellsOnGpu& spare, const CellsOnGpu& guess, const gpu::Buffer& kinds,
                const StepReportOnGpu& report, float cellsPerSpeed);
    [[nodiscard]] std::size_t bytes() const { return halfway_.bytes(); }

 private:
    void findPaths(const CellsOnGpu& cells, const CellsOnGpu& spare, const StepReportOnGpu& report,
                   float cellsPerSpeed);

    glm::ivec3 cells_;
    bool corrected_;
    gpu::Buffer halfway_;  ///< velocities half-way along the cells' paths
    Kernel centres_, findHalfway_, predict_, correct_, addCorrections_;
};

}  // namespace dustbench::grid_fluid::flow_gl
