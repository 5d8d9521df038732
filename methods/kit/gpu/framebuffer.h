// Textures that are drawn into.
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
    /// Either may be null, not both. Throws std::runtime_error where OpenGL refuses the combination.
    Framebuffer(Device& device, std::string_view label, const Texture* colour, const Texture* depth);

    /// Draws go here from now on, into the whole of it.
    void bind() const;
    void clearColour(float red, float green, float blue, float alpha) const;
    /// To the far end of the reversed depth range: 0.
    void clearDepth() const;

 private:
    Name name_;
    int width_ = 0;
    int height_ = 0;
};

}  // namespace dustbench::gpu
