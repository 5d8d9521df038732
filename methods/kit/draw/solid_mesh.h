// A solid's triangle mesh on the GPU.
//
// Units: metres. Frame: the object's. Owns: its buffers.
#pragma once

#include <glm/glm.hpp>

#include "methods/contract/solid.h"
#include "methods/kit/gpu/buffer.h"
#include "methods/kit/gpu/device.h"
#include "methods/kit/gpu/draw_call.h"

namespace dustbench::draw {

class DUSTBENCH_API SolidMesh {
 public:
    SolidMesh(gpu::Device& device, const scene::Solid& solid);

    /// Replaces the shape by one with the same triangles. Throws std::invalid_argument for another number of vertices.
    void reshape(const scene::Mesh& mesh);

    void draw(const gpu::Program& program, const gpu::DrawState& state, int instances = 1) const;

    [[nodiscard]] const glm::vec3& minimum() const { return minimum_; }
    [[nodiscard]] const glm::vec3& maximum() const { return maximum_; }
    [[nodiscard]] glm::vec3 centre() const { return (minimum_ + maximum_) / 2.0f; }
    /// Radius of the sphere about centre() that contains all vertices.
    [[nodiscard]] float radiusMetres() const { return radius_; }

 private:
    void write(const scene::Mesh& mesh);

    gpu::Buffer vertices_;
    gpu::Buffer indices_;
    gpu::VertexArray layout_;
    std::size_t vertexCount_;
    int indexCount_ = 0;
    glm::vec3 minimum_{0};
    glm::vec3 maximum_{0};
    float radius_ = 0;
};

}  // namespace dustbench::draw
