// Textures of one size that passes blend into, with a framebuffer for all of them.
//
// Owns: the textures. Threads: the OpenGL thread.
#pragma once

#include <string>
#include <vector>

#include "methods/kit/gpu/device.h"
#include "methods/kit/gpu/framebuffer.h"
#include "methods/kit/gpu/texture.h"

namespace dustbench::draw {

class DUSTBENCH_API SumTargets {
 public:
    /// Their bytes are booked under the name `label`. `initial`: the value that each is cleared to; 0 if left out.
    SumTargets(gpu::Device& device, std::string label, std::vector<gpu::Format> formats,
               std::vector<float> initial = {});

    /// Fits them to the given size, clears and binds them.
    void begin(int width, int height);
    [[nodiscard]] const gpu::Texture& texture(std::size_t i) const { return textures_.at(i); }
    [[nodiscard]] std::size_t gpuBytes() const;

 private:
    gpu::Device* device_;
    std::string label_;
    std::vector<gpu::Format> formats_;
    std::vector<float> initial_;
    std::vector<gpu::Texture> textures_;
    gpu::Framebuffer framebuffer_;
};

}  // namespace dustbench::draw
