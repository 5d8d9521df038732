// The triangles of a relief as a mesh of vertex indices; relief_mesh.vert computes the positions.
//
// Vertices: (columns + 2) × (rows + 2) of the surface, row by row, the outer ones at the rim; then the same number at
// the bottom. Triangles: two per patch, then lower, upper, left and right rim, then the back. Owns: the indices on the
// GPU. Threads: the OpenGL thread.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "methods/kit/gpu/buffer.h"
#include "methods/kit/gpu/device.h"
#include "methods/kit/gpu/vertex_array.h"

namespace dustbench::relief {

class ReliefMesh {
 public:
    ReliefMesh(gpu::Device& device, int columns, int rows);

    [[nodiscard]] const gpu::VertexArray& vertices() const { return vertices_; }
    [[nodiscard]] int indexCount() const { return indexCount_; }
    /// Number of triangles of the surface, of a horizontal rim and of a vertical rim.
    [[nodiscard]] glm::ivec3 triangles() const { return triangles_; }
    [[nodiscard]] std::size_t bytes() const { return indices_.bytes(); }

 private:
    gpu::Buffer indices_;
    gpu::VertexArray vertices_;
    int indexCount_ = 0;
    glm::ivec3 triangles_{0};
};

}  // namespace dustbench::relief
