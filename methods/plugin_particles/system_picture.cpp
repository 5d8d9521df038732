#include "methods/plugin_particles/system_picture.h"

namespace dustbench::plugin_particles {

scene::View seenBy(draw::Eye eye, const scene::View& view, float eyesMetres) {
    scene::View seen = view;
    const glm::dvec3 right = glm::normalize(glm::cross(view.camera.target - view.camera.eye, view.camera.up));
    const glm::dvec3 shift = right * (0.5 * static_cast<double>(eyesMetres) * (eye == draw::Eye::left ? -1 : 1));
    seen.camera.eye += shift;
    seen.camera.target += shift;
    return seen;
}

SystemPicture::SystemPicture(gpu::Device& device, const particles::Look& look, const scene::Lights& lights)
    : device_(device),
      look_(look),
      sort_(ledger_),
      pass_(makePass(device, look, lights)),
      light_(device),
      oneEye_(device),
      bothEyes_(device) {
    if (look.stereo || (isAdditive() && look.clamped)) blend_.emplace(device);
}

void SystemPicture::upload(const Moment& moment, const StageClock& clock) {
    const Puffs& puffs = moment.puffs;
    std::span<const std::uint32_t> order;
    if (!isAdditive() && !particles::isMesh(look_.primitive)) {
        const auto timing = clock.measure(Stage::sort);
        order = sort_.farToNear(draw::SortKind::radix, {puffs.x, puffs.y, puffs.z}, moment.eye);
    }
    const auto timing = clock.measure(Stage::upload);
    pass_->upload({puffs, order, moment.stepSeconds});
}

void SystemPicture::gather(const GpuPuffs& puffs, const glm::vec3& eye, const StageClock& clock) {
    const gpu::Buffer* order = nullptr;
    if (!isAdditive()) {
        const auto timing = clock.measure(Stage::sort);
        if (!gpuOrder_) gpuOrder_.emplace(device_);
        order = &gpuOrder_->farToNear(puffs, eye);
    }
    const auto timing = clock.measure(Stage::upload);
    pass_->gather(puffs, order);
}

void SystemPicture::draw(const scene::View& view, const gpu::Layer& layer) {
    if (!look_.stereo) return drawForEye(view, layer);
    const gpu::Layer& both = bothEyes_.clearedLike(layer);
    for (const draw::Eye eye : {draw::Eye::left, draw::Eye::right}) {
        const gpu::Layer& one = oneEye_.clearedLike(layer);
        drawForEye(seenBy(eye, view, look_.eyesMetres), one);
        blend_->addEye(one.colour(), both, eye);
    }
    blend_->over(both.colour(), layer);
}

void SystemPicture::drawForEye(const scene::View& view, const gpu::Layer& layer) {
    if (!isAdditive() || !look_.clamped) return pass_->draw(view, layer);
    const gpu::Layer& light = light_.clearedLike(layer);
    pass_->draw(view, light);
    blend_->add(light.colour(), layer, 1, true);
}

MemoryReport SystemPicture::memory() const {
    MemoryReport report;
    for (const auto& [structure, bytes] : ledger_.entries()) report.push_back({structure, bytes, 0});
    report.push_back({"primitives", 0, pass_->gpuBytes()});
    if (gpuOrder_) report.push_back({"depth order", 0, gpuOrder_->bytes()});
    if (pass_->cpuBytes() > 0) report.push_back({"last positions", pass_->cpuBytes(), 0});
    const std::size_t buffers = light_.gpuBytes() + oneEye_.gpuBytes() + bothEyes_.gpuBytes();
    if (buffers > 0) report.push_back({"own buffers", 0, buffers});
    return report;
}

}  // namespace dustbench::plugin_particles
