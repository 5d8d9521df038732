// Fills the ghosts of a state on the GPU, as fluid::fillGhosts does.
//
// Threads: the OpenGL thread's.
#pragma once

#include "methods/shared/fluid/box_ghosts.h"
#include "methods/shared/fluid_gl/cells_on_gpu.h"
#include "methods/shared/fluid_gl/kernel.h"

namespace dustbench::fluid_gl {

class GhostsOnGpu {
 public:
    GhostsOnGpu(gpu::Device& device, const glm::ivec3& cells, const fluid::GhostRule& rule);
    void fill(const CellsOnGpu& state, fluid::GhostUse use);

 private:
    glm::ivec3 cells_;
    Kernel kernel_;
};

}  // namespace dustbench::fluid_gl
