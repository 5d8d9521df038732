#include "methods/kit/raycast/grid_raycast.h"

#include <stdexcept>

#include "methods/kit/raycast/cell_splats.h"
#include "methods/kit/raycast/cpu_renderer.h"
#include "methods/kit/raycast/gl_renderers.h"
#include "methods/kit/raycast/iso_surface_pass.h"

namespace dustbench::raycast {
namespace {

/// Number of cells that a sample reads beyond its own.
int reachOf(Filter filter) {
    return filter == Filter::cubic ? 2 : 1;
}

/// Creates the renderer that `settings` select for this device. `device` and `ledger` must outlive it.
std::unique_ptr<GridRenderer> makeGridRenderer(gpu::Device& device, const RaycastSettings& settings,
                                               const scene::Lights& lights, MemoryLedger& ledger) {
    const Reflected reflected = cloudColour(settings.smokeColour, lights, settings.asymmetry);
    switch (settings.renderer) {
        case Renderer::slices:
            return std::make_unique<GlSlices>(device, settings, reflected);
        case Renderer::splat:
            return std::make_unique<CellSplats>(device, settings, reflected, ledger);
        case Renderer::isosurface:
            return std::make_unique<IsoSurfacePass>(device, settings, lights);
        case Renderer::raycast:
            break;
    }
    const bool onCpu =
        settings.backend == Backend::cpu || (settings.backend == Backend::automatic && device.isSoftware());
    if (onCpu) return std::make_unique<CpuRenderer>(device, settings, reflected, ledger);
    return std::make_unique<GlMarch>(device, settings, reflected);
}

}  // namespace

Reflected cloudColour(const glm::vec3& albedo, const scene::Lights& lights, float asymmetry) {
    const glm::vec3 often = albedo / (1.0f - albedo / 2.0f);
    return {often * lights.ambient, often * (lights.sun / 4.0f), lights.toSun, asymmetry};
}

SceneDepths SceneDepthCopy::depths() {
    if (values_.empty()) values_ = layer_.sceneDepth().readFloats();
    return {values_, layer_.width(), layer_.height()};
}

GridRenderer::~GridRenderer() = default;

void GridRenderer::take(const ShownTextures&, const BricksOnGpu&, const LightOnGpu*) {
    throw std::logic_error("this renderer does not take textures");
}

GridRaycast::GridRaycast(gpu::Device& device, const RaycastSettings& settings, const scene::Lights& lights,
                         MemoryLedger& ledger)
    : device_(device), settings_(settings), toSun_(lights.toSun), ledger_(ledger), bricks_(ledger) {
    check(settings);
    if (settings.shadowCells > 0) light_.emplace(settings, lights.toSun, ledger);
    renderer_ = makeGridRenderer(device, settings, lights, ledger);
}

GridRaycast::GridRaycast(Beside, const GridRaycast& sibling)
    : device_(sibling.device_),
      settings_(sibling.settings_),
      toSun_(sibling.toSun_),
      ledger_(sibling.ledger_),
      bricks_(ledger_),
      renderer_(sibling.renderer_->another()) {
    if (settings_.shadowCells > 0) light_.emplace(settings_, toSun_, ledger_);
}

void GridRaycast::upload(const ShownGrid& grid, const std::function<float(const glm::dvec3&)>& arriving) {
    drawable_ = false;
    check(grid);
    bricks_.set(grid, reachOf(settings_.filter));
    place_ = {{grid.cells, grid.spacingMetres, grid.originMetres, {}, {}}, bricks_.minimum(), bricks_.maximum()};
    if (bricks_.empty()) return;
    if (light_) light_->set(grid, arriving);
    renderer_->upload(grid, bricks_, light_ ? &*light_ : nullptr);
    drawable_ = true;
}

void GridRaycast::take(const ShownTextures& grid) {
    drawable_ = false;
    check(grid);
    if (!bricksOnGpu_) bricksOnGpu_.emplace(device_);
    if (!bricksOnGpu_->set(grid, reachOf(settings_.filter))) {
        // The CPU check throws with the position of the bad cell.
        const std::vector<float> density = grid.density->readFloats();
        bricks_.set({grid.cells, grid.spacingMetres, grid.originMetres, density, {}}, 0);
    }
    place_ = {
        {grid.cells, grid.spacingMetres, grid.originMetres, {}, {}}, bricksOnGpu_->minimum(), bricksOnGpu_->maximum()};
    if (bricksOnGpu_->empty()) return;
    if (settings_.shadowCells > 0) {
        if (!lightOnGpu_) lightOnGpu_.emplace(device_, settings_, toSun_);
        lightOnGpu_->set(grid);
    }
    renderer_->take(grid, *bricksOnGpu_, lightOnGpu_ ? &*lightOnGpu_ : nullptr);
    drawable_ = true;
}

void GridRaycast::change(const glm::dvec3& originMetres, float thickness) {
    place_.grid.originMetres = originMetres;
    place_.thickness = thickness;
}

void GridRaycast::draw(const scene::View& view, const gpu::Layer& layer) {
    SceneDepthCopy sceneDepth(layer);
    draw(view, layer, sceneDepth);
}

void GridRaycast::draw(const scene::View& view, const gpu::Layer& layer, SceneDepthCopy& sceneDepth) {
    primitives_ = drawable_ ? renderer_->draw(place_, view, layer, sceneDepth) : 0;
}

std::size_t GridRaycast::gpuBytes() const {
    const auto bytesOf = [](const auto& part) { return part ? part->gpuBytes() : std::size_t{0}; };
    return renderer_->gpuBytes() + bytesOf(bricksOnGpu_) + bytesOf(lightOnGpu_);
}

}  // namespace dustbench::raycast
