// Draws a grid of smoke and fire: by ray casting on the CPU or the GPU, or by an older technique.
//
// Units: metres, extinction per metre. Frame: world. Colours: linear RGB. Owns: the grid in the backend's layout.
// Threads: the OpenGL thread; the CPU march runs in parallel. Source: Senger2009, ch. 4.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>

#include "methods/kit/raycast/grid_renderer.h"

namespace dustbench::raycast {

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
