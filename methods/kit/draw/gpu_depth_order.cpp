#include "methods/kit/draw/gpu_depth_order.h"

#include <algorithm>

#include "draw_shaders.h"

namespace dustbench::draw {

GpuDepthOrder::Sorting::Sorting(gpu::Device& device, std::uint32_t puffs)
    : capacity(puffs),
      depths(device, "depth order", puffs * sizeof(float)),
      keys(device, "depth order", puffs * sizeof(std::uint32_t)),
      indices(device, "depth order", puffs * sizeof(std::uint32_t)),
      depthKeys(device, puffs),
      sort(device, puffs) {}

GpuDepthOrder::GpuDepthOrder(gpu::Device& device)
    : device_(device), distances_(device, "squared distances", {draw_shaders::squared_distances_comp}) {}

const gpu::Buffer& GpuDepthOrder::farToNear(const GpuPuffs& dust, const glm::vec3& eye) {
    constexpr std::uint32_t least = 4096;
    if (!sorting_ || dust.bound > sorting_->capacity) {
        const std::uint32_t doubled = sorting_ ? 2 * sorting_->capacity : least;
        sorting_.emplace(device_, std::max(dust.bound, doubled));
    }
    distances_.set("eye", eye);
    dust.position->bindStorage(0);
    dust.tally->bindStorage(1);
    sorting_->depths.bindStorage(2);
    distances_.dispatchIndirect(*dust.tally, sizeof(std::uint32_t));
    const gpu::ElementCount count(*dust.tally);
    sorting_->depthKeys.write(sorting_->depths, count, gpu::DepthOrder::backToFront, sorting_->keys, sorting_->indices);
    sorting_->sort.sort(sorting_->keys, sorting_->indices, count);
    return sorting_->indices;
}

std::size_t GpuDepthOrder::bytes() const {
    if (!sorting_) return 0;
    return sorting_->depths.bytes() + sorting_->keys.bytes() + sorting_->indices.bytes() + sorting_->sort.bytes();
}

}  // namespace dustbench::draw
