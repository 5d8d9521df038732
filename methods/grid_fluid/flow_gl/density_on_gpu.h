// The density of a cloud on the GPU: conserves its total as density_balance.h does, without reading back to the host,
// and exchanges it with the surroundings of the box.
//
// Threads: the OpenGL thread's.
#pragma once

#include <span>
#include <vector>

#include "methods/grid_fluid/flow/solver.h"
#include "methods/grid_fluid/flow_gl/cells_on_gpu.h"
#include "methods/grid_fluid/flow_gl/kernel.h"

namespace dustbench::grid_fluid::flow_gl {

/// Conserves the total density.
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

/// Exchanges density between a fluid's box on the GPU and its surroundings on the host.
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
