// Ray casting on the GPU: a pass over the pixels that may see the grid.
//
// Owns: the grid on the GPU. Threads: the OpenGL thread's. Source: Senger2009, ch. 4.
#pragma once

#include <cstddef>
#include <optional>

#include "methods/shared/gpu/layer.h"
#include "methods/shared/gpu/vertex_array.h"
#include "methods/shared/raycast/brick_map.h"
#include "methods/shared/raycast/bricks_on_gpu.h"
#include "methods/shared/raycast/grid_on_gpu.h"
#include "methods/shared/raycast/pixel_rays.h"

namespace dustbench::raycast {

class GlMarch {
 public:
    GlMarch(gpu::Device& device, const RaycastSettings& settings);

    /// `light`: null where the cloud casts no shadow on itself.
    void upload(const ShownGrid& grid, const BrickMap& bricks, const LightVolume* light);
    /// What lies on the GPU already.
    void take(const ShownTextures& grid, const BricksOnGpu& bricks, const LightOnGpu* light);
    void draw(const PixelRays& rays, const PixelRectangle& pixels, const Reflected& reflected, const gpu::Layer& layer);

    [[nodiscard]] std::size_t gpuBytes() const { return grid_.gpuBytes() + bricks_.bytes(); }

 private:
    [[nodiscard]] gpu::Program& program();

    gpu::Device& device_;
    RaycastSettings settings_;
    GridOnGpu grid_;
    gpu::Texture bricks_;
    const gpu::Texture* takenBricks_ = nullptr;  ///< somebody else's, where those are looked into
    glm::ivec3 least_{0}, most_{0};
    gpu::VertexArray vertices_;
    std::optional<gpu::Program> smokeAlone_, withFire_;  ///< made when first wanted
};

}  // namespace dustbench::raycast
