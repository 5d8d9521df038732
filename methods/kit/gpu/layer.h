// Where a method draws: its own colour target over the opaque scene's depth.
//
// Units: depth is reversed (scene/view.h). Frame: image rows from the bottom, as OpenGL has them.
#pragma once

#include "methods/kit/gpu/framebuffer.h"
#include "methods/kit/gpu/texture.h"

namespace dustbench::gpu {

class DUSTBENCH_API Layer {
 public:
    /// `sceneDepth` (Depth32F) must outlive the layer. `format`: Rgba32F, or Rgba16F where the user asks for it.
    Layer(Device& device, const Texture& sceneDepth, Format format = Format::rgba32F);

    void clear();
    /// Target with the scene's depth attached: depth test on, depth writes off.
    void bindWithSceneDepth() const;
    /// Target without a depth attachment, so that `sceneDepth()` may be sampled in the same pass.
    void bindColourOnly() const;

    [[nodiscard]] const Texture& sceneDepth() const { return sceneDepth_; }
    [[nodiscard]] const Texture& colour() const { return colour_; }
    [[nodiscard]] int width() const { return colour_.width(); }
    [[nodiscard]] int height() const { return colour_.height(); }

 private:
    const Texture& sceneDepth_;
    Texture colour_;
    Framebuffer withDepth_;
    Framebuffer colourOnly_;
};

}  // namespace dustbench::gpu
