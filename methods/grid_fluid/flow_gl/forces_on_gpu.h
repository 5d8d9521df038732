// Sources, and forces other than pressure, on the GPU, as in flow::FluidSolver, flow::applyForces and flow::diffuse.
//
// Units: SI. Threads: the OpenGL thread's. Source: Fedkiw2001, Eq. 8 and 11; Senger2009, Eq. 7.
#pragma once

#include <span>

#include "methods/grid_fluid/flow/fluid_box.h"
#include "methods/grid_fluid/flow/fluid_source.h"
#include "methods/grid_fluid/flow/forces.h"
#include "methods/grid_fluid/flow_gl/cells_on_gpu.h"
#include "methods/grid_fluid/flow_gl/kernel.h"

namespace dustbench::grid_fluid::flow_gl {

/// Adds all of a step's sources at once.
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
