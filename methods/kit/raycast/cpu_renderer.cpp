#include "methods/kit/raycast/cpu_renderer.h"

namespace dustbench::raycast {

CpuRenderer::CpuRenderer(gpu::Device& device, const RaycastSettings& settings, const Reflected& reflected,
                         MemoryLedger& ledger)
    : reflected_(reflected), march_(settings, ledger), composite_(device) {}

void CpuRenderer::upload(const ShownGrid& grid, const BrickMap& bricks, const LightVolume* light) {
    march_.upload(grid, bricks, light);
}

std::int64_t CpuRenderer::draw(const GridPlace& place, const scene::View& view, const gpu::Layer& layer) {
    const PixelRectangle pixels = pixelsOf(place.grid, place.minimum, place.maximum, view);
    if (pixels.empty()) return 0;
    const std::vector<float> depths = layer.sceneDepth().readFloats();
    const PacketPicture picture = composite_.map(pixels, march_.channels());
    march_.march(PixelRays(place.grid, view), {depths, layer.width(), layer.height()}, reflected_, picture);
    composite_.draw(reflected_.all(), layer);
    return pixels.count();
}

}  // namespace dustbench::raycast
