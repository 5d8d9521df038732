// Draws a grid of smoke and fire: by a ray through it for each pixel, on the CPU or the GPU, or in an older way.
//
// Units: metres, extinction per metre. Frame: world. Colours: linear RGB. Owns: the grid as the backend wants it.
// Threads: the OpenGL thread's; the CPU's march spreads over the others. Source: Senger2009, ch. 4.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>

#include "methods/kit/raycast/grid_renderer.h"

namespace dustbench::raycast {

class DUSTBENCH_API GridRaycast {
 public:
    /// `device` and `ledger` must outlive this. Throws InputError for settings out of range.
    GridRaycast(gpu::Device& device, const RaycastSettings& settings, const scene::Lights& lights,
                MemoryLedger& ledger);

    /// Takes over all that is drawn; the grid may go afterwards. Throws InputError for a grid that has no cells, or a
    /// density that is negative or not a number; then nothing is drawn.
    void upload(const ShownGrid& grid);

    /// The same for what lies on the GPU already; only where `takesTextures()`.
    void take(const ShownTextures& grid);
    /// The march and the slices do where OpenGL makes them: nothing then goes over the host.
    [[nodiscard]] bool takesTextures() const { return renderer_->takesTextures(); }

    /// Draws what was uploaded last, as often as wanted.
    void draw(const scene::View& view, const gpu::Layer& layer);

    [[nodiscard]] std::size_t gpuBytes() const;
    /// Rays that the last draw cast, or what else it drew: planes, splats, triangles.
    [[nodiscard]] std::int64_t primitives() const { return primitives_; }

 private:
    gpu::Device& device_;
    RaycastSettings settings_;
    glm::vec3 toSun_;
    BrickMap bricks_;
    std::optional<LightVolume> light_;        ///< none: no shadow
    std::optional<BricksOnGpu> bricksOnGpu_;  ///< made when first wanted
    std::optional<LightOnGpu> lightOnGpu_;
    std::unique_ptr<GridRenderer> renderer_;
    GridPlace place_;
    bool drawable_ = false;
    std::int64_t primitives_ = 0;
};

}  // namespace dustbench::raycast
