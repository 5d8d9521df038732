#include "methods/kit/raycast/bricks_on_gpu.h"

#include <array>

#include "methods/kit/raycast/brick_map.h"
#include "methods/kit/raycast/grid_on_gpu.h"
#include "raycast_shaders.h"

namespace dustbench::raycast {

BricksOnGpu::BricksOnGpu(gpu::Device& device)
    : device_(device),
      program_(device, "grid bricks", {raycast_shaders::grid_bricks_comp}, {{"BRICK", std::to_string(BrickMap::edge)}}),
      bounds_(device, "ray cast bricks", 2 * sizeof(glm::ivec4)) {}

bool BricksOnGpu::set(const ShownTextures& grid, int reach) {
    const glm::ivec3 bricks = (grid.cells + BrickMap::edge - 1) / BrickMap::edge;
    fitTexture(bricks_, device_, "ray cast bricks", gpu::Format::r8, bricks, gpu::Filter::nearest);
    std::array<glm::ivec4, 2> bounds{glm::ivec4(bricks, 0), glm::ivec4(0)};
    bounds_.write(std::span<const glm::ivec4>(bounds));
    program_.set("reach", reach);
    bricks_.bindImage(0, false, true);
    grid.density->bind(1);
    bounds_.bindStorage(0);
    dispatchForTexels(program_, bricks);
    bounds_.read(std::span<glm::ivec4>(bounds));
    minimum_ = glm::ivec3(bounds[0]) * BrickMap::edge;
    maximum_ = glm::min(glm::ivec3(bounds[1]) * BrickMap::edge, grid.cells);
    return bounds[1].w == 0;
}

}  // namespace dustbench::raycast
