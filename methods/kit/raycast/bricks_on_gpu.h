// Which bricks of a grid that lies on the GPU hold any density: what BrickMap knows, found there.
//
// Owns: the texture of bricks. Threads: the OpenGL thread's.
#pragma once

#include "methods/kit/gpu/buffer.h"
#include "methods/kit/gpu/program.h"
#include "methods/kit/gpu/texture.h"
#include "methods/kit/raycast/shown_grid.h"

namespace dustbench::raycast {

class BricksOnGpu {
 public:
    explicit BricksOnGpu(gpu::Device& device);

    /// `reach`: cells that a sample sees beyond its own. False where a density is negative or not a number. Waits for
    /// the GPU: the host must know the box that all bricks lie in.
    [[nodiscard]] bool set(const ShownTextures& grid, int reach);

    /// 1 or 0 by brick.
    [[nodiscard]] const gpu::Texture& texture() const { return bricks_; }
    [[nodiscard]] bool empty() const { return minimum_.x >= maximum_.x; }
    /// Cells [minimum, most) hold all occupied bricks.
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
