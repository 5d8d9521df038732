#include "methods/shared/raycast/grid_raycast.h"

namespace dustbench::raycast {
namespace {

/// Cells that a sample sees beyond its own.
int reachOf(Filter filter) {
    return filter == Filter::cubic ? 2 : 1;
}

}  // namespace

Reflected cloudColour(const glm::vec3& albedo, const scene::Lights& lights) {
    const glm::vec3 often = albedo / (1.0f - albedo / 2.0f);
    return {often * lights.ambient, often * (lights.sun / 4.0f)};
}

GridRaycast::GridRaycast(gpu::Device& device, const RaycastSettings& settings, const scene::Lights& lights,
                         MemoryLedger& ledger)
    : device_(device),
      settings_(settings),
      reflected_(cloudColour(settings.smokeColour, lights)),
      toSun_(lights.toSun),
      bricks_(ledger) {
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
    bricks_.set(grid, reachOf(settings_.filter));
    least_ = bricks_.least();
    most_ = bricks_.most();
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

void GridRaycast::take(const ShownTextures& grid) {
    drawable_ = false;
    check(grid);
    if (!bricksOnGpu_) bricksOnGpu_.emplace(device_);
    if (!bricksOnGpu_->set(grid, reachOf(settings_.filter))) {
        // It says where.
        const std::vector<float> density = grid.density->readFloats();
        bricks_.set({grid.cells, grid.spacingMetres, grid.originMetres, density, {}}, 0);
    }
    least_ = bricksOnGpu_->least();
    most_ = bricksOnGpu_->most();
    grid_ = {grid.cells, grid.spacingMetres, grid.originMetres, {}, {}};
    if (bricksOnGpu_->empty()) return;
    if (settings_.shadowCells > 0) {
        if (!lightOnGpu_) lightOnGpu_.emplace(device_, settings_, toSun_);
        lightOnGpu_->set(grid);
    }
    const LightOnGpu* const light = lightOnGpu_ ? &*lightOnGpu_ : nullptr;
    if (gl_) gl_->take(grid, *bricksOnGpu_, light);
    if (slices_) slices_->take(grid, *bricksOnGpu_, light);
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
    const PixelRectangle pixels = pixelsOf(grid_, least_, most_, view);
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
    return bytesOf(bricksOnGpu_) + bytesOf(lightOnGpu_) + bytesOf(gl_) + bytesOf(composite_) + bytesOf(slices_) +
           bytesOf(splats_) + bytesOf(surface_);
}

}  // namespace dustbench::raycast
