// Advects all quantities of the cells on the GPU, as flow::Advection does.
//
// The first guesses have their own field; the spare field stores first the centres' velocities, then the corrections.
// Source: Stam1999, 2.2; Selle2008, Eq. 4 and 3.2. Threads: the OpenGL thread's.
#pragma once

#include <optional>

#include "methods/grid_fluid/flow/advection.h"
#include "methods/grid_fluid/flow_gl/cells_on_gpu.h"
#include "methods/grid_fluid/flow_gl/kernel.h"

namespace dustbench::grid_fluid::flow_gl {

class AdvectionOnGpu {
 public:
    AdvectionOnGpu(gpu::Device& device, const flow::CellLayout& layout, flow::AdvectionRule rule);

    /// Bytes of its largest buffer, and of all buffers.
    static std::size_t largestBytes(const flow::CellLayout& layout, flow::AdvectionRule rule);
    static std::size_t allBytes(const flow::CellLayout& layout, flow::AdvectionRule rule);

    /// Advects `cells`, with ghosts filled, by `cellsPerSpeed` = Δt/h; `spare` and `guess` are temporary. The report
    /// must contain the maximum speeds. `ahead` is flow::AdvectionStep's.
    void advect(CellsOnGpu& cells, CellsOnGpu& spare, const CellsOnGpu& guess, const gpu::Buffer& kinds,
                const StepReportOnGpu& report, float cellsPerSpeed, float ahead);
    /// Moves the data kept between steps by whole cells; new cells get the wind's velocity. `spare` is temporary.
    void scroll(const glm::ivec3& by, const glm::vec3& wind, CellsOnGpu& spare);
    [[nodiscard]] std::size_t bytes() const { return halfway_.bytes() + (last_ ? last_->velocities.bytes() : 0); }

 private:
    /// The velocities at the centres in the last step, if paths follow those of the middle of a step.
    struct Last {
        gpu::Buffer velocities;
        Kernel keep, scroll;
    };
    void findPaths(const CellsOnGpu& cells, const CellsOnGpu& spare, const StepReportOnGpu& report, float cellsPerSpeed,
                   float ahead);
    void keepVelocities(const CellsOnGpu& cells) const;

    glm::ivec3 cells_;
    bool corrected_;
    gpu::Buffer halfway_;  ///< velocities half-way along the cells' paths; and at the centres (paths.glsl)
    std::optional<Last> last_;
    Kernel centres_, findHalfway_, predict_, correct_, addCorrections_;
};

}  // namespace dustbench::grid_fluid::flow_gl
