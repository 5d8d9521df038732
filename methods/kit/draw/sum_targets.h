// Textures of one size that passes add to, with a framebuffer for all of them.
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
    /// Their bytes are booked under the name `label`.
    SumTargets(gpu::Device& device, std::string label, std::vector<gpu::Format> formats);

    /// Fits them to the given size, clears them to 0 and binds them.
    void begin(int width, int height);
    [[nodiscard]] const gpu::Texture& texture(std::size_t i) const { return textures_.at(i); }
    [[nodiscard]] std::size_t gpuBytes() const;

 private:
    gpu::Device* device_;
    std::string label_;
    std::vector<gpu::Format> formats_;
    std::vector<gpu::Texture> textures_;
    gpu::Framebuffer framebuffer_;
};

}  // namespace dustbench::draw
