// Finds the bricks with density in a grid that is on the GPU: BrickMap's GPU counterpart.
//
// Owns: the texture of bricks. Threads: the OpenGL thread.
#pragma once

#include "methods/kit/gpu/buffer.h"
#include "methods/kit/gpu/program.h"
#include "methods/kit/gpu/texture.h"
#include "methods/kit/raycast/shown_grid.h"

namespace dustbench::raycast {

class BricksOnGpu {
 public:
    explicit BricksOnGpu(gpu::Device& device);

    /// `reach`: number of cells that a sample reads beyond its own. Returns false if a density is negative or NaN.
    /// Waits for the GPU, because the host needs the bounding box of all bricks.
    [[nodiscard]] bool set(const ShownTextures& grid, int reach);

    /// 1 or 0 per brick.
    [[nodiscard]] const gpu::Texture& texture() const { return bricks_; }
    [[nodiscard]] bool empty() const { return minimum_.x >= maximum_.x; }
    /// The range [minimum, maximum) of cells contains all occupied bricks.
    [[nodiscard]] const glm::ivec3& minimum() const { return minimum_; }
    [[nodiscard]] const glm::ivec3& maximum() const { return maximum_; }
    [[nodiscard]] std::size_t gpuBytes() const { return bricks_.bytes() + bounds_.bytes(); }

 private:
    gpu::Device& device_;
    gpu::Program program_;
    gpu::Texture bricks_;
    gpu::Buffer bounds_;
    glm::ivec3 minimum_{0}, maximum_{0};
};

}  // namespace dustbench::raycast
