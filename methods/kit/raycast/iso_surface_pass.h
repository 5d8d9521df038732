// Draws an isosurface of a grid as opaque triangles.
//
// The triangles have their own depth buffer and are drawn to a separate picture, which is then composited over the
// layer. Shows smoke only: fire emits no light here. Owns: triangles and picture on the GPU. Threads: the OpenGL
// thread. Source: Senger2009, ch. 2.
#pragma once

#include "methods/kit/gpu/buffer.h"
#include "methods/kit/gpu/framebuffer.h"
#include "methods/kit/gpu/program.h"
#include "methods/kit/gpu/vertex_array.h"
#include "methods/kit/raycast/grid_renderer.h"

namespace dustbench::raycast {

class IsoSurfacePass final : public GridRenderer {
 public:
    IsoSurfacePass(gpu::Device& device, const RaycastSettings& settings, const scene::Lights& lights);

    void upload(const ShownGrid& grid, const BrickMap& bricks, const LightVolume* light) override;
    std::int64_t draw(const GridPlace& place, const scene::View& view, const gpu::Layer& layer) override;

    [[nodiscard]] std::size_t gpuBytes() const override {
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
