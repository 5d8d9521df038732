#include "methods/volume/sparse/sparse_picture.h"

#include "methods/contract/errors.h"
#include "methods/kit/raycast/grid_renderer.h"
#include "methods/volume/sparse/sparse_light.h"

namespace dustbench::volume {

void requireSparse(const raycast::RaycastSettings& settings) {
    if (settings.renderer != raycast::Renderer::raycast)
        throw InputError("parameter renderer: got " + std::string(raycast::renderers.wordOf(settings.renderer)) +
                         " with storage=sparse, allowed: raycast");
    if (settings.filter != raycast::Filter::linear)
        throw InputError("parameter filter: got " + std::string(raycast::filters.wordOf(settings.filter)) +
                         " with storage=sparse, allowed: linear");
}

SparsePicture::SparsePicture(gpu::Device& device, const raycast::RaycastSettings& settings, const scene::Lights& lights,
                             MemoryLedger& ledger)
    : settings_(settings),
      reflected_(raycast::cloudColour(settings.smokeColour, lights, settings.asymmetry)),
      fire_(settings.fire.table()),
      march_(settings),
      composite_(device) {
    raycast::check(settings);
    requireSparse(settings);
    if (settings.shadowCells > 0) light_.emplace(settings, lights.toSun, ledger);
    const bool onCpu = settings.backend == raycast::Backend::cpu ||
                       (settings.backend == raycast::Backend::automatic && device.isSoftware());
    if (!onCpu) onGpu_.emplace(device, settings);
}

void SparsePicture::upload(const SparseMoment& moment) {
    moment_ = nullptr;
    if (moment.density.empty()) return;
    if (light_) {
        requireLightFits(moment, settings_.shadowCells, onGpu_.has_value());
        light_->set(moment.place(),
                    [&](std::span<float> averages) { meanDensities(moment, fire_, settings_.shadowCells, averages); });
    }
    const raycast::LightVolume* const light = light_ ? &*light_ : nullptr;
    if (onGpu_)
        onGpu_->upload(moment, light);
    else
        march_.set(moment, light);
    moment_ = &moment;
}

void SparsePicture::draw(const scene::View& view, const gpu::Layer& layer) {
    primitives_ = 0;
    if (!moment_) return;
    const raycast::PixelRectangle pixels =
        raycast::pixelsOf(moment_->place(), moment_->minimum(), moment_->maximum(), view);
    if (pixels.empty()) return;
    primitives_ = pixels.count();
    if (onGpu_) return onGpu_->draw(*moment_, pixels, reflected_, view, layer);
    raycast::SceneDepthCopy sceneDepth(layer);
    const raycast::SceneDepths depths = sceneDepth.depths();
    const raycast::PacketPicture picture = composite_.map(pixels, march_.channels());
    march_.march(raycast::PixelRays(moment_->place(), view), depths, reflected_, picture);
    composite_.draw(reflected_.all(), layer);
}

std::size_t SparsePicture::gpuBytes() const {
    return composite_.gpuBytes() + (onGpu_ ? onGpu_->gpuBytes() : 0);
}

}  // namespace dustbench::volume
