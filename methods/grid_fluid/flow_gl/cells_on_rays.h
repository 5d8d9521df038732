// Fills the cells of a grid that are inside closed meshes, by OpenGL: the same cells as MeshCells, by the same rays.
//
// A pass over the triangles counts the rays that each crosses, a second one stores the crossings, and a pass over the
// rays sorts these and fills the cells. If the GPU's double precision rounds as the standard requires, no cell differs.
// Units: cells. Owns its buffers. Threads: the OpenGL thread's.
// Source: Crane2007, 30.2.4. Departs: rays and their crossings instead of slices and the stencil buffer.
#pragma once

#include <cstdint>
#include <span>

#include "methods/grid_fluid/flow_gl/kernel.h"
#include "methods/kit/gpu/buffer.h"

namespace dustbench::grid_fluid::flow_gl {

class CellsOnRays {
 public:
    CellsOnRays(gpu::Device& device, glm::ivec3 cells);

    /// Sets the number of each cell, x fastest, before the first mesh.
    void begin(std::span<const std::uint8_t> bodies);
    /// Sets the cells of a mesh to `body`, above 0; `places`: positions of its vertices in cells.
    void add(std::span<const glm::dvec3> places, std::span<const std::uint32_t> indices, std::uint8_t body);
    /// Waits for the GPU.
    void read(std::span<std::uint8_t> bodies) const;

    [[nodiscard]] std::size_t bytes() const;

 private:
    void sweep(std::span<const glm::dvec3> places, std::span<const std::uint32_t> indices, int axis, std::uint8_t body);
    void reserve(gpu::Buffer& buffer, std::size_t bytes);

    gpu::Device& device_;
    glm::ivec3 cells_;
    gpu::Buffer places_, indices_, counts_, firsts_, crossings_, total_, bodies_;
    Kernel countCrossings_, storeCrossings_, placeRays_, fillRays_;
};

}  // namespace dustbench::grid_fluid::flow_gl
