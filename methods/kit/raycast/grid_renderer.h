// The interface of all techniques that draw a grid of smoke and fire; GridRaycast creates one of them.
//
// Threads: the OpenGL thread.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "methods/contract/scene.h"
#include "methods/contract/view.h"
#include "methods/kit/gpu/layer.h"
#include "methods/kit/raycast/brick_map.h"
#include "methods/kit/raycast/bricks_on_gpu.h"
#include "methods/kit/raycast/cpu_march.h"
#include "methods/kit/raycast/light_on_gpu.h"
#include "methods/kit/raycast/light_volume.h"
#include "methods/kit/raycast/raycast_settings.h"
#include "methods/kit/raycast/shown_grid.h"

namespace dustbench::raycast {

/// Light reflected by a thick cloud of this albedo; the same for all methods (scene::dustColour).
[[nodiscard]] DUSTBENCH_API Reflected cloudColour(const glm::vec3& albedo, const scene::Lights& lights,
                                                  float asymmetry = 0);

/// Placement of the grid uploaded last, and the range [minimum, maximum) of cells that contains all of its density.
struct GridPlace {
    ShownGrid grid;  ///< position and size only, no values
    glm::ivec3 minimum{0}, maximum{0};
    float thickness = 1;  ///< current share of the extinction of its densities
};

/// The scene's depths of a layer on the CPU, read back on first use and shared by all grids of a picture.
class DUSTBENCH_API SceneDepthCopy {
 public:
    explicit SceneDepthCopy(const gpu::Layer& layer) : layer_(layer) {}
    [[nodiscard]] SceneDepths depths();

 private:
    const gpu::Layer& layer_;
    std::vector<float> values_;
};

/// Selects the constructor for another grid of the same picture.
struct Beside {};

class GridRenderer {
 public:
    virtual ~GridRenderer() = default;

    /// `light`: null if the cloud casts no shadow on itself. `light` and `bricks` must outlive all draws of this grid.
    virtual void upload(const ShownGrid& grid, const BrickMap& bricks, const LightVolume* light) = 0;

    [[nodiscard]] virtual bool takesTextures() const { return false; }
    /// The same for a grid that is already on the GPU; only if `takesTextures()`.
    virtual void take(const ShownTextures& grid, const BricksOnGpu& bricks, const LightOnGpu* light);

    /// Draws the grid uploaded last. Returns the number of rays, planes, splats or triangles.
    virtual std::int64_t draw(const GridPlace& place, const scene::View& view, const gpu::Layer& layer,
                              SceneDepthCopy& sceneDepth) = 0;

    /// Creates a renderer of the same kind for another grid of the same picture; the two share their programs.
    [[nodiscard]] virtual std::unique_ptr<GridRenderer> another() const = 0;

    [[nodiscard]] virtual std::size_t gpuBytes() const = 0;
};

/// Creates the renderer that `settings` select for this device. `device` and `ledger` must outlive it.
[[nodiscard]] std::unique_ptr<GridRenderer> makeGridRenderer(gpu::Device& device, const RaycastSettings& settings,
                                                             const scene::Lights& lights, MemoryLedger& ledger);

}  // namespace dustbench::raycast
