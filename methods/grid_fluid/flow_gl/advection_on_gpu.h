// Advects all quantities of the cells on the GPU, as flow::Advection does.
//
// The first guesses have their own field; departure points are stored in the output field.
// Source: Stam1999, 2.2; Selle2008, Eq. 4 and 3.2. Threads: the OpenGL thread's.
#pragma once

#include "methods/grid_fluid/flow/advection.h"
#include "methods/grid_fluid/flow_gl/cells_on_gpu.h"
#include "methods/grid_fluid/flow_gl/kernel.h"
#include "methods/grid_fluid/flow_gl/step_report.h"

namespace dustbench::grid_fluid::flow_gl {

class AdvectionOnGpu {
 public:
    AdvectionOnGpu(gpu::Device& device, const glm::ivec3& cells, flow::AdvectionRule rule);

    /// Advects `from`, with ghosts filled, by `cellsPerSpeed` = Δt/h into `to`; `guess` is temporary. The report must
    /// contain the maximum speeds.
    void advect(const CellsOnGpu& from, const CellsOnGpu& to, const CellsOnGpu& guess, const gpu::Buffer& kinds,
                const StepReportOnGpu& report, float cellsPerSpeed);

 private:
    glm::ivec3 cells_;
    bool corrected_;
    Kernel predict_, correct_;
};

}  // namespace dustbench::grid_fluid::flow_gl
