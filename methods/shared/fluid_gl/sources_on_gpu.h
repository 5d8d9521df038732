// What flows in, on the GPU: all of a step's sources at once, as fluid::FluidSolver adds them.
//
// Threads: the OpenGL thread's.
#pragma once

#include <span>

#include "methods/shared/fluid/fluid_box.h"
#include "methods/shared/fluid/fluid_source.h"
#include "methods/shared/fluid_gl/cells_on_gpu.h"
#include "methods/shared/fluid_gl/kernel.h"

namespace dustbench::fluid_gl {

class SourcesOnGpu {
 public:
    SourcesOnGpu(gpu::Device& device, const glm::ivec3& cells);

    /// Throws InputError for a source without a radius.
    void add(const CellsOnGpu& state, const gpu::Buffer& kinds, const fluid::FluidBox& box,
             std::span<const fluid::FluidSource> sources, float stepSeconds);
    [[nodiscard]] std::size_t bytes() const { return sources_.bytes() + added_.bytes(); }

 private:
    gpu::Device& device_;
    gpu::Buffer sources_, added_;
    Kernel amounts_, add_;
};

}  // namespace dustbench::fluid_gl
