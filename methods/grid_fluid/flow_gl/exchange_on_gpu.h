// Exchanges density between a fluid's box on the GPU and its surroundings on the host.
//
// Threads: the OpenGL thread's.
#pragma once

#include <span>
#include <vector>

#include "methods/grid_fluid/flow/exchanged_density.h"
#include "methods/grid_fluid/flow_gl/cells_on_gpu.h"
#include "methods/grid_fluid/flow_gl/kernel.h"

namespace dustbench::grid_fluid::flow_gl {

class ExchangeOnGpu {
 public:
    ExchangeOnGpu(gpu::Device& device, const glm::ivec3& cells);

    /// Records, before a step, the density that will leave through each face of the open sides. `cellsPerSpeed` = Δt/h.
    void noteLeaving(const CellsOnGpu& state, const gpu::Buffer& kinds, float cellsPerSpeed);
    /// Replaces `leaving` by the last record. Waits for the GPU.
    void readLeaving(std::vector<flow::LeavingDensity>& leaving);
    /// Adds density to distinct cells.
    void add(const CellsOnGpu& state, std::span<const flow::AddedDensity> added);
    [[nodiscard]] std::size_t bytes() const { return faces_.bytes() + added_.bytes(); }

 private:
    gpu::Device& device_;
    glm::ivec3 cells_;
    std::vector<glm::vec2> noted_;  ///< by face: distance in cells, density
    gpu::Buffer faces_, added_;
    Kernel leaving_, add_;
};

}  // namespace dustbench::grid_fluid::flow_gl
