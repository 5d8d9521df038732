// A set of textures as render target.
//
// Owns: the OpenGL framebuffer, not the textures, which must outlive it.
#pragma once

#include <string_view>

#include "methods/kit/gpu/device.h"
#include "methods/kit/gpu/name.h"
#include "methods/kit/gpu/texture.h"

namespace dustbench::gpu {

class DUSTBENCH_API Framebuffer {
 public:
    Framebuffer() = default;
    /// Either may be null, but not both. Throws std::runtime_error if OpenGL rejects the combination.
    Framebuffer(Device& device, std::string_view label, const Texture* colour, const Texture* depth);

    /// Directs subsequent draws to this framebuffer, over its whole area.
    void bind() const;
    void clearColour(float red, float green, float blue, float alpha) const;
    /// Clears to 0, the far end of the reversed depth range.
    void clearDepth() const;
    /// Copies the colour to the lower left corner of the current context's window.
    void copyToWindow() const;

 private:
    Name name_;
    int width_ = 0;
    int height_ = 0;
};

}  // namespace dustbench::gpu
