// Draws a grid that is on the GPU: by ray casting, or as textured planes.
//
// Owns: the grid on the GPU. Units: cells. Threads: the OpenGL thread. Source: Senger2009, ch. 2 and 4.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "methods/kit/gpu/buffer.h"
#include "methods/kit/gpu/draw_call.h"
#include "methods/kit/raycast/grid_on_gpu.h"
#include "methods/kit/raycast/grid_raycast.h"

namespace dustbench::raycast {

/// The programs of a renderer, compiled on first use.
struct SmokeAndFire {
    std::optional<gpu::Program> smokeAlone, withFire;
};

/// Ray casting: one pass over the pixels that may see the grid.
class GlMarch final : public GridRenderer {
 public:
    GlMarch(gpu::Device& device, const RaycastSettings& settings, const Reflected& reflected);
    GlMarch(Beside, const GlMarch& sibling);

    void upload(const ShownGrid& grid, const BrickMap& bricks, const LightVolume* light) override;
    [[nodiscard]] bool takesTextures() const override { return true; }
    void take(const ShownTextures& grid, const BricksOnGpu& bricks, const LightOnGpu* light) override;
    std::int64_t draw(const GridPlace& place, const scene::View& view, const gpu::Layer& layer,
                      SceneDepthCopy& sceneDepth) override;
    [[nodiscard]] std::unique_ptr<GridRenderer> another() const override;

    [[nodiscard]] std::size_t gpuBytes() const override { return grid_.gpuBytes() + bricks_.bytes(); }

 private:
    [[nodiscard]] gpu::Program& program();

    gpu::Device& device_;
    RaycastSettings settings_;
    Reflected reflected_;
    GridOnGpu grid_;
    gpu::Texture bricks_;
    const gpu::Texture* takenBricks_ = nullptr;  ///< external bricks if the grid was taken, not uploaded
    glm::ivec3 minimum_{0}, maximum_{0};
    gpu::VertexArray vertices_;
    std::shared_ptr<SmokeAndFire> programs_;  ///< shared with siblings
};

/// Textured planes perpendicular to the view, blended far to near.
class GlSlices final : public GridRenderer {
 public:
    GlSlices(gpu::Device& device, const RaycastSettings& settings, const Reflected& reflected);
    GlSlices(Beside, const GlSlices& sibling);

    void upload(const ShownGrid& grid, const BrickMap& bricks, const LightVolume* light) override;
    [[nodiscard]] bool takesTextures() const override { return true; }
    void take(const ShownTextures& grid, const BricksOnGpu& bricks, const LightOnGpu* light) override;
    std::int64_t draw(const GridPlace& place, const scene::View& view, const gpu::Layer& layer,
                      SceneDepthCopy& sceneDepth) override;
    [[nodiscard]] std::unique_ptr<GridRenderer> another() const override;

    [[nodiscard]] std::size_t gpuBytes() const override { return grid_.gpuBytes() + slices_.bytes(); }

 private:
    [[nodiscard]] gpu::Program& program();

    gpu::Device& device_;
    RaycastSettings settings_;
    Reflected reflected_;
    GridOnGpu grid_;
    glm::ivec3 minimum_{0}, maximum_{0};
    gpu::Buffer slices_;
    gpu::VertexArray vertices_;
    std::shared_ptr<SmokeAndFire> programs_;  ///< shared with siblings
};

}  // namespace dustbench::raycast
