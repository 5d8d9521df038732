#include "methods/kit/gpu/sort/depth_keys.h"

#include <string>

#include "gpu_sort_shaders.h"

namespace dustbench::gpu {
namespace {

constexpr std::uint32_t depthTile = 2048;

}  // namespace

DepthKeys::DepthKeys(Device& device, std::uint32_t capacity)
    : plan_(device, capacity, depthTile),
      program_(device, "depth keys",
               {gpu_sort_shaders::group_glsl, gpu_sort_shaders::sortable_glsl, gpu_sort_shaders::depth_keys_comp},
               {{"TILE_ELEMENTS", std::to_string(depthTile) + "u"}}) {}

void DepthKeys::write(const Buffer& depths, const ElementCount& count, DepthOrder order, Buffer& keys,
                      Buffer& indices) {
    plan_.set(count);
    plan_.bind();
    depths.bindStorage(1);
    keys.bindStorage(2);
    indices.bindStorage(3);
    program_.set("backToFront", order == DepthOrder::backToFront ? 1 : 0);
    plan_.runPerTile(program_);
}

}  // namespace dustbench::gpu
