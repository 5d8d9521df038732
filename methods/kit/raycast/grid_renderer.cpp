#include "methods/kit/raycast/grid_renderer.h"

#include <stdexcept>

#include "methods/kit/raycast/cell_splats.h"
#include "methods/kit/raycast/cpu_renderer.h"
#include "methods/kit/raycast/gl_march.h"
#include "methods/kit/raycast/gl_slices.h"
#include "methods/kit/raycast/iso_surface_pass.h"

namespace dustbench::raycast {

Reflected cloudColour(const glm::vec3& albedo, const scene::Lights& lights, float asymmetry) {
    const glm::vec3 often = albedo / (1.0f - albedo / 2.0f);
    return {often * lights.ambient, often * (lights.sun / 4.0f), lights.toSun, asymmetry};
}

SceneDepths SceneDepthCopy::depths() {
    if (values_.empty()) values_ = layer_.sceneDepth().readFloats();
    return {values_, layer_.width(), layer_.height()};
}

void GridRenderer::take(const ShownTextures&, const BricksOnGpu&, const LightOnGpu*) {
    throw std::logic_error("this renderer does not take textures");
}

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

}  // namespace dustbench::raycast
