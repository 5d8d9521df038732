// Draws an isosurface of a grid as opaque triangles.
//
// The triangles have their own depth buffer and are drawn to a separate picture, which is then composited over the
// layer. Shows smoke only: fire emits no light here. Owns: triangles and picture on the GPU. Threads: the OpenGL
// thread. Source: Senger2009, ch. 2.
#pragma once

#include "methods/kit/gpu/buffer.h"
#include "methods/kit/gpu/draw_call.h"
#include "methods/kit/gpu/framebuffer.h"
#include "methods/kit/gpu/program.h"
#include "methods/kit/raycast/grid_raycast.h"

namespace dustbench::raycast {

class IsoSurfacePass final : public GridRenderer {
 public:
    IsoSurfacePass(gpu::Device& device, const RaycastSettings& settings, const scene::Lights& lights);
    IsoSurfacePass(Beside, const IsoSurfacePass& sibling);

    void upload(const ShownGrid& grid, const BrickMap& bricks, const LightVolume* light) override;
    /// Uses the surface of the densities as uploaded, independent of the place's thickness.
    std::int64_t draw(const GridPlace& place, const scene::View& view, const gpu::Layer& layer,
                      SceneDepthCopy& sceneDepth) override;
    [[nodiscard]] std::unique_ptr<GridRenderer> another() const override;

    [[nodiscard]] std::size_t gpuBytes() const override {
        return vertexBuffer_.bytes() + indexBuffer_.bytes() +
               (first_ ? shared_->colour.bytes() + shared_->depth.bytes() : 0);
    }

 private:
    /// Resources shared by siblings.
    struct Shared {
        explicit Shared(gpu::Device& device);
        gpu::Program surface, composite;
        gpu::Texture colour, depth;
        gpu::Framebuffer target;
    };

    gpu::Device& device_;
    RaycastSettings settings_;
    scene::Lights lights_;
    std::shared_ptr<Shared> shared_;
    bool first_ = true;
    gpu::Buffer vertexBuffer_, indexBuffer_;
    gpu::VertexArray vertices_, noVertices_;
    std::size_t indexCount_ = 0;
};

}  // namespace dustbench::raycast
