// Fills the ghosts of a state on the GPU, as flow::fillGhosts does.
//
// Threads: the OpenGL thread's.
#pragma once

#include "methods/grid_fluid/flow/box_ghosts.h"
#include "methods/grid_fluid/flow_gl/cells_on_gpu.h"
#include "methods/grid_fluid/flow_gl/kernel.h"

namespace dustbench::grid_fluid::flow_gl {

class GhostsOnGpu {
 public:
    GhostsOnGpu(gpu::Device& device, const glm::ivec3& cells, const flow::GhostRule& rule);
    /// As flow::fillGhosts and flow::setSideFaces.
    void fill(const CellsOnGpu& state);
    void setSideFaces(const CellsOnGpu& state);

 private:
    glm::ivec3 cells_;
    Kernel ghosts_, sideFaces_;
};

}  // namespace dustbench::grid_fluid::flow_gl
