// Draws a grid of smoke and fire: by a ray through it for each pixel, on the CPU or the GPU, or in an older way.
//
// Units: metres, extinction per metre. Frame: world. Colours: linear RGB. Owns: the grid as the backend wants it.
// Threads: the OpenGL thread's; the CPU's march spreads over the others. Source: Senger2009, ch. 4.
#pragma once

#include <cstdint>
#include <optional>

#include "methods/shared/memory_ledger.h"
#include "methods/shared/raycast/brick_map.h"
#include "methods/shared/raycast/bricks_on_gpu.h"
#include "methods/shared/raycast/cell_splats.h"
#include "methods/shared/raycast/cpu_march.h"
#include "methods/shared/raycast/gl_march.h"
#include "methods/shared/raycast/gl_slices.h"
#include "methods/shared/raycast/iso_surface_pass.h"
#include "methods/shared/raycast/light_on_gpu.h"
#include "methods/shared/raycast/packet_composite.h"
#include "methods/shared/raycast/raycast_settings.h"
#include "methods/shared/scene/lights.h"

namespace dustbench::raycast {

/// What a thick cloud of this albedo reflects; the same for all methods (scene::dustColour).
[[nodiscard]] Reflected cloudColour(const glm::vec3& albedo, const scene::Lights& lights);

class GridRaycast {
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
    [[nodiscard]] bool takesTextures() const { return gl_ || slices_; }

    /// Draws what was uploaded last, as often as wanted.
    void draw(const scene::View& view, const gpu::Layer& layer);

    /// `cpu` or `gl`.
    [[nodiscard]] Backend backend() const { return cpu_ ? Backend::cpu : Backend::gl; }
    [[nodiscard]] std::size_t gpuBytes() const;
    /// Rays that the last draw cast, or what else it drew: planes, splats, triangles.
    [[nodiscard]] std::int64_t primitives() const { return primitives_; }

 private:
    gpu::Device& device_;
    RaycastSettings settings_;
    Reflected reflected_;
    glm::vec3 toSun_;
    BrickMap bricks_;
    std::optional<LightVolume> light_;
    std::optional<BricksOnGpu> bricksOnGpu_;  ///< made when first wanted
    std::optional<LightOnGpu> lightOnGpu_;
    std::optional<GlMarch> gl_;  ///< one of these five
    std::optional<GlSlices> slices_;
    std::optional<CellSplats> splats_;
    std::optional<IsoSurfacePass> surface_;
    std::optional<CpuMarch> cpu_;
    std::optional<PacketComposite> composite_;
    ShownGrid grid_;                 ///< its place and size; it looks at no values
    glm::ivec3 least_{0}, most_{0};  ///< cells that all density lies in
    bool drawable_ = false;
    std::int64_t primitives_ = 0;
};

}  // namespace dustbench::raycast
