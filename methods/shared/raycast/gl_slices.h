// Textured planes across the view, blended from the farthest to the nearest.
//
// Owns: the grid on the GPU. Units: cells. Threads: the OpenGL thread's. Source: Senger2009, ch. 2.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "methods/shared/gpu/buffer.h"
#include "methods/shared/gpu/layer.h"
#include "methods/shared/gpu/vertex_array.h"
#include "methods/shared/raycast/brick_map.h"
#include "methods/shared/raycast/bricks_on_gpu.h"
#include "methods/shared/raycast/grid_on_gpu.h"
#include "methods/shared/raycast/pixel_rays.h"

namespace dustbench::raycast {

class GlSlices {
 public:
    GlSlices(gpu::Device& device, const RaycastSettings& settings);

    /// `light`: null where the cloud casts no shadow on itself.
    void upload(const ShownGrid& grid, const BrickMap& bricks, const LightVolume* light);
    /// What lies on the GPU already.
    void take(const ShownTextures& grid, const BricksOnGpu& bricks, const LightOnGpu* light);
    /// Returns how many planes there were.
    int draw(const PixelRays& rays, const scene::View& view, const Reflected& reflected, const gpu::Layer& layer);

    [[nodiscard]] std::size_t gpuBytes() const { return grid_.gpuBytes() + slices_.bytes(); }

 private:
    [[nodiscard]] gpu::Program& program();

    gpu::Device& device_;
    RaycastSettings settings_;
    GridOnGpu grid_;
    glm::ivec3 least_{0}, most_{0};
    gpu::Buffer slices_;
    gpu::VertexArray vertices_;
    std::optional<gpu::Program> smokeAlone_, withFire_;  ///< made when first wanted
};

}  // namespace dustbench::raycast
