#include "methods/shared/raycast/grid_raycast.h"

namespace dustbench::raycast {

glm::vec3 cloudColour(const glm::vec3& albedo, const scene::Lights& lights) {
    return albedo / (1.0f - albedo / 2.0f) * (lights.ambient + lights.sun / 4.0f);
}

GridRaycast::GridRaycast(gpu::Device& device, const RaycastSettings& settings, const scene::Lights& lights,
                         MemoryLedger& ledger)
    : settings_(settings),
      reflected_(cloudColour(settings.smokeColour, lights)),
      bricks_(ledger),
      gl_(device, settings) {
    check(settings);
}

void GridRaycast::upload(const ShownGrid& grid) {
    drawable_ = false;
    check(grid);
    bricks_.set(grid, settings_.filter == Filter::cubic ? 2 : 1);
    grid_ = {grid.cells, grid.spacingMetres, grid.originMetres, {}, {}};
    if (bricks_.empty()) return;
    gl_.upload(grid, bricks_);
    drawable_ = true;
}

void GridRaycast::draw(const scene::View& view, const gpu::Layer& layer) {
    rays_ = 0;
    if (!drawable_) return;
    const PixelRectangle pixels = pixelsOf(grid_, bricks_.least(), bricks_.most(), view);
    if (pixels.empty()) return;
    rays_ = static_cast<std::int64_t>(pixels.width()) * pixels.height();
    gl_.draw(PixelRays(grid_, view), pixels, reflected_, layer);
}

}  // namespace dustbench::raycast
