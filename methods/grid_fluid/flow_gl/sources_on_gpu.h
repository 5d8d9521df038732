// Adds all of a step's sources at once on the GPU, as flow::FluidSolver does.
//
// Threads: the OpenGL thread's.
#pragma once

#include <span>

#include "methods/grid_fluid/flow/fluid_box.h"
#include "methods/grid_fluid/flow/fluid_source.h"
#include "methods/grid_fluid/flow_gl/cells_on_gpu.h"
#include "methods/grid_fluid/flow_gl/kernel.h"

namespace dustbench::grid_fluid::flow_gl {

class SourcesOnGpu {
 public:
    SourcesOnGpu(gpu::Device& device, const glm::ivec3& cells);

    /// Throws InputError for a source without a radius.
    void add(const CellsOnGpu& state, const gpu::Buffer& kinds, const flow::FluidBox& box,
             std::span<const flow::FluidSource> sources, float stepSeconds);
    [[nodiscard]] std::size_t bytes() const { return sources_.bytes() + added_.bytes(); }

 private:
    gpu::Device& device_;
    gpu::Buffer sources_, added_;
    Kernel amounts_, add_;
};

}  // namespace dustbench::grid_fluid::flow_gl
