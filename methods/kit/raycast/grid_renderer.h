// One way to draw a grid of smoke and fire: what all of them offer to GridRaycast, which makes one of them.
//
// Threads: the OpenGL thread's.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>

#include "methods/contract/scene.h"
#include "methods/contract/view.h"
#include "methods/kit/gpu/layer.h"
#include "methods/kit/raycast/brick_map.h"
#include "methods/kit/raycast/bricks_on_gpu.h"
#include "methods/kit/raycast/light_on_gpu.h"
#include "methods/kit/raycast/light_volume.h"
#include "methods/kit/raycast/raycast_settings.h"
#include "methods/kit/raycast/shown_grid.h"

namespace dustbench::raycast {

/// What a thick cloud of this albedo reflects; the same for all methods (scene::dustColour).
[[nodiscard]] Reflected cloudColour(const glm::vec3& albedo, const scene::Lights& lights);

/// Where the grid that was uploaded last stands, and the cells [minimum, most) that all of its density lies in.
struct GridPlace {
    ShownGrid grid;  ///< its place and size; it looks at no values
    glm::ivec3 minimum{0}, maximum{0};
};

class GridRenderer {
 public:
    virtual ~GridRenderer() = default;

    /// `light`: null where the cloud casts no shadow on itself. It and `bricks` must outlive the pictures of this grid.
    virtual void upload(const ShownGrid& grid, const BrickMap& bricks, const LightVolume* light) = 0;

    [[nodiscard]] virtual bool takesTextures() const { return false; }
    /// The same for what lies on the GPU already; only where `takesTextures()`.
    virtual void take(const ShownTextures& grid, const BricksOnGpu& bricks, const LightOnGpu* light);

    /// Draws what was uploaded last. Returns how many rays, planes, splats or triangles that were.
    virtual std::int64_t draw(const GridPlace& place, const scene::View& view, const gpu::Layer& layer) = 0;

    [[nodiscard]] virtual std::size_t gpuBytes() const = 0;
};

/// The one that `settings` ask for on this device. `device` and `ledger` must outlive it.
[[nodiscard]] std::unique_ptr<GridRenderer> makeGridRenderer(gpu::Device& device, const RaycastSettings& settings,
                                                             const scene::Lights& lights, MemoryLedger& ledger);

}  // namespace dustbench::raycast
