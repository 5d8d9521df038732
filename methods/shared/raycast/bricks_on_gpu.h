// Which bricks of a grid that lies on the GPU hold any density: what BrickMap knows, found there.
//
// Owns: the texture of bricks. Threads: the OpenGL thread's.
#pragma once

#include "methods/shared/gpu/buffer.h"
#include "methods/shared/gpu/program.h"
#include "methods/shared/gpu/texture.h"
#include "methods/shared/raycast/shown_grid.h"

namespace dustbench::raycast {

class BricksOnGpu {
 public:
    explicit BricksOnGpu(gpu::Device& device);

    /// `reach`: cells that a sample sees beyond its own. False where a density is negative or not a number. Waits for
    /// the GPU: the host must know the box that all bricks lie in.
    [[nodiscard]] bool set(const ShownTextures& grid, int reach);

    /// 1 or 0 by brick.
    [[nodiscard]] const gpu::Texture& texture() const { return bricks_; }
    [[nodiscard]] bool empty() const { return least_.x >= most_.x; }
    /// Cells [least, most) hold all occupied bricks.
    [[nodiscard]] const glm::ivec3& least() const { return least_; }
    [[nodiscard]] const glm::ivec3& most() const { return most_; }
    [[nodiscard]] std::size_t gpuBytes() const { return bricks_.bytes() + bounds_.bytes(); }

 private:
    gpu::Device& device_;
    gpu::Program program_;
    gpu::Texture bricks_;
    gpu::Buffer bounds_;
    glm::ivec3 least_{0}, most_{0};
};

}  // namespace dustbench::raycast
