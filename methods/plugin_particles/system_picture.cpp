#include "methods/plugin_particles/system_picture.h"

#include "methods/kit/parallel/for_each_block.h"

namespace dustbench::plugin_particles {

SystemPicture::SystemPicture(gpu::Device& device) : sort_(ledger_), billboards_(device, {}) {}

void SystemPicture::upload(const Puffs& puffs, const glm::vec3& eye, const StageClock& clock) {
    colourOfAll_ = puffs.colourOfAll;
    std::span<const std::uint32_t> order;
    {
        const auto timing = clock.measure(Stage::sort);
        order = sort_.farToNear(draw::SortKind::radix, {puffs.x, puffs.y, puffs.z}, eye);
    }
    const auto timing = clock.measure(Stage::upload);
    const draw::InstanceLayout layout = billboards_.layout(!puffs.uniformColour);
    const std::span<float> memory = billboards_.map(order.size(), layout);
    parallel::forEachBlock(order.size(), 16'384, [&](std::size_t first, std::size_t count) {
        float* value = memory.data() + first * layout.floats;
        for (const std::uint32_t i : order.subspan(first, count)) {
            for (const float next : {puffs.x[i], puffs.y[i], puffs.z[i], puffs.radius[i], puffs.opacity[i]})
                *value++ = next;
            if (!layout.coloured) continue;
            for (const float next : {puffs.red[i], puffs.green[i], puffs.blue[i]}) *value++ = next;
        }
    });
    billboards_.unmap();
}

void SystemPicture::draw(const scene::View& view, const gpu::Layer& layer) {
    billboards_.draw(view, colourOfAll_, layer);
}

MemoryReport SystemPicture::memory() const {
    MemoryReport report;
    for (const auto& [structure, bytes] : ledger_.entries()) report.push_back({structure, bytes, 0});
    report.push_back({"billboards", 0, billboards_.gpuBytes()});
    return report;
}

}  // namespace dustbench::plugin_particles
