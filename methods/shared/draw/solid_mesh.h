// A solid's triangles on the GPU.
//
// Units: metres. Frame: the object's own. Owns: its buffers.
#pragma once

#include <glm/glm.hpp>

#include "methods/shared/gpu/buffer.h"
#include "methods/shared/gpu/device.h"
#include "methods/shared/gpu/draw_call.h"
#include "methods/shared/gpu/vertex_array.h"
#include "methods/shared/scene/solid.h"

namespace dustbench::draw {

class SolidMesh {
 public:
    SolidMesh(gpu::Device& device, const scene::Solid& solid);

    void draw(const gpu::Program& program, const gpu::DrawState& state) const;

    [[nodiscard]] const glm::vec3& least() const { return least_; }
    [[nodiscard]] const glm::vec3& most() const { return most_; }
    [[nodiscard]] glm::vec3 centre() const { return (least_ + most_) / 2.0f; }
    /// Of the sphere about centre() that holds every vertex.
    [[nodiscard]] float radiusMetres() const { return radius_; }

 private:
    gpu::Buffer vertices_;
    gpu::Buffer indices_;
    gpu::VertexArray layout_;
    int indexCount_ = 0;
    glm::vec3 least_{0};
    glm::vec3 most_{0};
    float radius_ = 0;
};

}  // namespace dustbench::draw
