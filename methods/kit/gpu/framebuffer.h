// A set of textures as render target.
//
// Owns: the OpenGL framebuffer, not the textures, which must outlive it.
#pragma once

#include <span>
#include <string_view>

#include "methods/kit/gpu/device.h"
#include "methods/kit/gpu/ownership.h"
#include "methods/kit/gpu/texture.h"

namespace dustbench::gpu {

/// While it exists, draws into framebuffers with a colour and the size width × height change only a rectangle of
/// pixels, counted from the lower left corner: what nobody sees needs no time. Clears and framebuffers of other sizes
/// are whole. One at a time.
class DUSTBENCH_API DrawnPart {
 public:
    DrawnPart(int width, int height, int left, int bottom, int columns, int rows);
    ~DrawnPart();
    DrawnPart(const DrawnPart&) = delete;
    DrawnPart& operator=(const DrawnPart&) = delete;
};

class DUSTBENCH_API Framebuffer {
 public:
    Framebuffer() = default;
    /// Either may be null, but not both. Throws std::runtime_error if OpenGL rejects the combination.
    Framebuffer(Device& device, std::string_view label, const Texture* colour, const Texture* depth);
    /// Several colours of one size, without depth: a fragment shader's outputs by location. Throws std::runtime_error
    /// as above, and std::invalid_argument for none or more than 8.
    Framebuffer(Device& device, std::string_view label, std::span<const Texture* const> colours);

    /// Directs subsequent draws to this framebuffer, over its whole area.
    void bind() const;
    /// Clears all colours.
    void clearColour(float red, float green, float blue, float alpha) const;
    /// Clears the colour of one output to `value` in all channels.
    void clearOutput(int output, float value) const;
    /// Clears to 0, the far end of the reversed depth range.
    void clearDepth() const;
    /// Copies the colour to the lower left corner of the current context's window.
    void copyToWindow() const;

 private:
    void create(std::string_view label);
    void complete(std::string_view label, const Texture& any);

    Name name_;
    int colours_ = 1;  ///< 0: only a depth
    int width_ = 0;
    int height_ = 0;
};

}  // namespace dustbench::gpu
