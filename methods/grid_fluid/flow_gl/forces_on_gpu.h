// Forces other than pressure on the GPU, as in flow::applyForces and flow::diffuse.
//
// Units: SI. Threads: the OpenGL thread's. Source: Fedkiw2001, Eq. 8 and 11; Senger2009, Eq. 7.
#pragma once

#include "methods/grid_fluid/flow/forces.h"
#include "methods/grid_fluid/flow_gl/cells_on_gpu.h"
#include "methods/grid_fluid/flow_gl/kernel.h"

namespace dustbench::grid_fluid::flow_gl {

class ForcesOnGpu {
 public:
    ForcesOnGpu(gpu::Device& device, const glm::ivec3& cells, const flow::ForceSettings& settings, float spacingMetres);

    /// Applies all forces except viscosity; `state` needs ghosts if there is confinement. Both spares are overwritten.
    void apply(const CellsOnGpu& state, const CellsOnGpu& spare, const CellsOnGpu& otherSpare, const gpu::Buffer& kinds,
               float stepSeconds);
    /// One explicit step of viscosity, from one field to another; `diffusion` = ν·Δt/h².
    void diffuse(const CellsOnGpu& from, const CellsOnGpu& to, const gpu::Buffer& kinds, float diffusion);

 private:
    glm::ivec3 cells_;
    flow::ForceSettings settings_;
    float spacingMetres_;
    Kernel curl_, centreForces_, spread_, forces_, diffuse_;
};

}  // namespace dustbench::grid_fluid::flow_gl
