// Draws an isosurface of a grid as opaque triangles.
//
// They hide each other by depths of their own, in a picture that is then put over the layer. Smoke alone: what burns
// shows no light. Owns: triangles and picture on the GPU. Threads: the OpenGL thread's. Source: Senger2009, ch. 2.
#pragma once

#include <cstddef>
#include <optional>

#include "methods/shared/gpu/buffer.h"
#include "methods/shared/gpu/framebuffer.h"
#include "methods/shared/gpu/layer.h"
#include "methods/shared/gpu/program.h"
#include "methods/shared/gpu/vertex_array.h"
#include "methods/shared/raycast/iso_surface.h"
#include "methods/shared/raycast/raycast_settings.h"
#include "methods/shared/scene/lights.h"
#include "methods/shared/scene/view.h"

namespace dustbench::raycast {

class IsoSurfacePass {
 public:
    IsoSurfacePass(gpu::Device& device, const RaycastSettings& settings, const scene::Lights& lights);

    void upload(const ShownGrid& grid);
    void draw(const scene::View& view, const gpu::Layer& layer);

    [[nodiscard]] std::size_t triangles() const { return indexCount_ / 3; }
    [[nodiscard]] std::size_t gpuBytes() const {
        return vertexBuffer_.bytes() + indexBuffer_.bytes() + colour_.bytes() + depth_.bytes();
    }

 private:
    gpu::Device& device_;
    RaycastSettings settings_;
    scene::Lights lights_;
    gpu::Program surface_, composite_;
    gpu::Buffer vertexBuffer_, indexBuffer_;
    gpu::VertexArray vertices_, noVertices_;
    gpu::Texture colour_, depth_;
    gpu::Framebuffer target_;
    glm::dvec3 originMetres_{0};
    std::size_t indexCount_ = 0;
};

}  // namespace dustbench::raycast
