// The framebuffer for the panels, with the current size of the window.
//
// Owns: the texture and its framebuffer. Threads: the device's.
#pragma once

#include "methods/kit/gpu/framebuffer.h"
#include "methods/kit/gpu/texture.h"

namespace dustbench::bench {

class PanelTarget {
 public:
    explicit PanelTarget(gpu::Device& device) : device_(device) {}

    /// False for a window without an area, such as a minimised one: then there is no target.
    bool fit(int width, int height) {
        if (width < 1 || height < 1) return false;
        if (width != texture_.width() || height != texture_.height()) {
            texture_ = gpu::Texture::make2D(device_, "window", gpu::Format::rgba8, width, height);
            framebuffer_ = gpu::Framebuffer(device_, "window", &texture_, nullptr);
        }
        return true;
    }
    /// Valid after the first fit() that returned true.
    [[nodiscard]] gpu::Texture& texture() { return texture_; }
    [[nodiscard]] const gpu::Framebuffer& framebuffer() const { return framebuffer_; }

 private:
    gpu::Device& device_;
    gpu::Texture texture_;
    gpu::Framebuffer framebuffer_;
};

}  // namespace dustbench::bench
