// Draws a grid of smoke and fire: by ray casting on the CPU or the GPU, or by an older technique.
//
// Units: metres, extinction per metre. Frame: world. Colours: linear RGB. Owns: the grid in the backend's layout.
// Threads: the OpenGL thread; the CPU march runs in parallel. Source: Senger2009, ch. 4.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "methods/contract/scene.h"
#include "methods/contract/view.h"
#include "methods/kit/gpu/layer.h"
#include "methods/kit/raycast/brick_map.h"
#include "methods/kit/raycast/cpu_march.h"
#include "methods/kit/raycast/grid_on_gpu.h"
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

/// The interface of all techniques; GridRaycast creates one of them.
class DUSTBENCH_API GridRenderer {
 public:
    virtual ~GridRenderer();

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

class DUSTBENCH_API GridRaycast {
 public:
    /// `device` and `ledger` must outlive this. Throws InputError for settings out of range.
    GridRaycast(gpu::Device& device, const RaycastSettings& settings, const scene::Lights& lights,
                MemoryLedger& ledger);
    /// For another grid of the same picture, with the same settings: the two share their programs.
    GridRaycast(Beside, const GridRaycast& sibling);

    /// Copies all data to draw; the grid need not outlive the call. Throws InputError if the grid has no cells or a
    /// density is negative or NaN; nothing is drawn after an error.
    /// `arriving`: see LightVolume::set.
    void upload(const ShownGrid& grid, const std::function<float(const glm::dvec3&)>& arriving = {});

    /// The same for a grid that is already on the GPU; only if `takesTextures()`.
    void take(const ShownTextures& grid);
    /// True for the march and the slices on OpenGL: no data pass through the host then.
    [[nodiscard]] bool takesTextures() const { return renderer_->takesTextures(); }

    /// Draws the grid uploaded last in another position and with this share of its extinction. Its light is unchanged.
    void change(const glm::dvec3& originMetres, float thickness);

    /// Draws the grid uploaded last; may be called repeatedly.
    void draw(const scene::View& view, const gpu::Layer& layer);
    /// The same for one of several grids, which share the scene's depths.
    void draw(const scene::View& view, const gpu::Layer& layer, SceneDepthCopy& sceneDepth);

    [[nodiscard]] std::size_t gpuBytes() const;
    /// Number of rays cast by the last draw, or of the planes, splats or triangles drawn.
    [[nodiscard]] std::int64_t primitives() const { return primitives_; }

 private:
    gpu::Device& device_;
    RaycastSettings settings_;
    glm::vec3 toSun_;
    MemoryLedger& ledger_;
    BrickMap bricks_;
    std::optional<LightVolume> light_;        ///< empty: no shadow
    std::optional<BricksOnGpu> bricksOnGpu_;  ///< created on first use
    std::optional<LightOnGpu> lightOnGpu_;
    std::unique_ptr<GridRenderer> renderer_;
    GridPlace place_;
    bool drawable_ = false;
    std::int64_t primitives_ = 0;
};

}  // namespace dustbench::raycast
