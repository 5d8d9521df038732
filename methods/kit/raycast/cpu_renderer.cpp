#include "methods/kit/raycast/cpu_renderer.h"

namespace dustbench::raycast {

CpuRenderer::CpuRenderer(gpu::Device& device, const RaycastSettings& settings, const Reflected& reflected,
                         MemoryLedger& ledger)
    : settings_(settings), reflected_(reflected), ledger_(ledger), march_(settings, ledger), composite_(device) {}

CpuRenderer::CpuRenderer(Beside, const CpuRenderer& sibling)
    : settings_(sibling.settings_),
      reflected_(sibling.reflected_),
      ledger_(sibling.ledger_),
      march_(settings_, ledger_),
      composite_(Beside(), sibling.composite_) {}

std::unique_ptr<GridRenderer> CpuRenderer::another() const {
    return std::make_unique<CpuRenderer>(Beside(), *this);
}

void CpuRenderer::upload(const ShownGrid& grid, const BrickMap& bricks, const LightVolume* light) {
    march_.upload(grid, bricks, light);
}

std::int64_t CpuRenderer::draw(const GridPlace& place, const scene::View& view, const gpu::Layer& layer,
                               SceneDepthCopy& sceneDepth) {
    const PixelRectangle pixels = pixelsOf(place.grid, place.minimum, place.maximum, view);
    if (pixels.empty()) return 0;
    const SceneDepths depths = sceneDepth.depths();
    const PacketPicture picture = composite_.map(pixels, march_.channels());
    march_.march(PixelRays(place.grid, view), depths, reflected_, picture, place.thickness);
    composite_.draw(reflected_.all(), layer);
    return pixels.count();
}

}  // namespace dustbench::raycast
