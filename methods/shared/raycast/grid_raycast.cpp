#include "methods/shared/raycast/grid_raycast.h"

namespace dustbench::raycast {

Reflected cloudColour(const glm::vec3& albedo, const scene::Lights& lights) {
    const glm::vec3 often = albedo / (1.0f - albedo / 2.0f);
    return {often * lights.ambient, often * (lights.sun / 4.0f)};
}

GridRaycast::GridRaycast(gpu::Device& device, const RaycastSettings& settings, const scene::Lights& lights,
                         MemoryLedger& ledger)
    : settings_(settings), reflected_(cloudColour(settings.smokeColour, lights)), bricks_(ledger) {
    check(settings);
    if (settings.shadowCells > 0) light_.emplace(settings, lights.toSun, ledger);
    if (settings.renderer == Renderer::slices) {
        slices_.emplace(device, settings);
    } else if (settings.renderer == Renderer::splat) {
        splats_.emplace(device, settings, ledger);
    } else if (settings.renderer == Renderer::isosurface) {
        surface_.emplace(device, settings, lights);
    } else if (settings.backend == Backend::cpu || (settings.backend == Backend::automatic && device.isSoftware())) {
        cpu_.emplace(settings, ledger);
        composite_.emplace(device);
    } else {
        gl_.emplace(device, settings);
    }
}

void GridRaycast::upload(const ShownGrid& grid) {
    drawable_ = false;
    check(grid);
    bricks_.set(grid, settings_.filter == Filter::cubic ? 2 : 1);
    grid_ = {grid.cells, grid.spacingMetres, grid.originMetres, {}, {}};
    if (bricks_.empty()) return;
    if (light_) light_->set(grid);
    const LightVolume* const light = light_ ? &*light_ : nullptr;
    if (cpu_) cpu_->upload(grid, bricks_, light);
    if (gl_) gl_->upload(grid, bricks_, light);
    if (slices_) slices_->upload(grid, bricks_, light);
    if (splats_) splats_->upload(grid, reflected_, light);
    if (surface_) surface_->upload(grid);
    drawable_ = true;
}

void GridRaycast::draw(const scene::View& view, const gpu::Layer& layer) {
    primitives_ = 0;
    if (!drawable_) return;
    if (splats_) {
        splats_->draw(view, layer);
        primitives_ = static_cast<std::int64_t>(splats_->count());
        return;
    }
    if (surface_) {
        surface_->draw(view, layer);
        primitives_ = static_cast<std::int64_t>(surface_->triangles());
        return;
    }
    const PixelRays rays(grid_, view);
    if (slices_) {
        primitives_ = slices_->draw(rays, view, reflected_, layer);
        return;
    }
    const PixelRectangle pixels = pixelsOf(grid_, bricks_.least(), bricks_.most(), view);
    if (pixels.empty()) return;
    primitives_ = static_cast<std::int64_t>(pixels.width()) * pixels.height();
    if (gl_) {
        gl_->draw(rays, pixels, reflected_, layer);
        return;
    }
    const std::vector<float> depths = layer.sceneDepth().readFloats();
    const PacketPicture picture = composite_->map(pixels, cpu_->channels());
    cpu_->march(rays, {depths, layer.width(), layer.height()}, reflected_, picture);
    composite_->draw(reflected_.all(), layer);
}

std::size_t GridRaycast::gpuBytes() const {
    const auto bytesOf = [](const auto& part) { return part ? part->gpuBytes() : std::size_t{0}; };
    return bytesOf(gl_) + bytesOf(composite_) + bytesOf(slices_) + bytesOf(splats_) + bytesOf(surface_);
}

}  // namespace dustbench::raycast
