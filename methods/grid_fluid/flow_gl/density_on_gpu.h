// Conserves the total density of a cloud on the GPU, as density_balance.h does, without reading back to the host.
//
// Threads: the OpenGL thread's.
#pragma once

#include "methods/grid_fluid/flow_gl/cells_on_gpu.h"
#include "methods/grid_fluid/flow_gl/kernel.h"

namespace dustbench::grid_fluid::flow_gl {

class DensityOnGpu {
 public:
    DensityOnGpu(gpu::Device& device, const glm::ivec3& cells);

    /// Records the density covered by solids, before their cells are emptied.
    void noteCovered(const CellsOnGpu& state, const gpu::Buffer& kinds) { sum(state, kinds, 2, 0); }
    /// Records, before a step, the total due after it. `cellsPerSpeed` = Δt/h.
    void noteDue(const CellsOnGpu& state, const gpu::Buffer& kinds, float cellsPerSpeed) {
        sum(state, kinds, 1, cellsPerSpeed);
    }
    /// Scales all densities to this total, by at most a tenth.
    void restore(const CellsOnGpu& state, const gpu::Buffer& kinds);
    [[nodiscard]] std::size_t bytes() const { return sums_.bytes() + balance_.bytes(); }

 private:
    void sum(const CellsOnGpu& state, const gpu::Buffer& kinds, int what, float cellsPerSpeed);

    glm::ivec3 cells_;
    int groups_;
    gpu::Buffer sums_, balance_;
    Kernel sum_, total_, scale_;
};

}  // namespace dustbench::grid_fluid::flow_gl
