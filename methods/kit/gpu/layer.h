// The render target of a method: a colour buffer over the opaque scene's depth.
//
// Units: depth is reversed (contract/view.h). Frame: image rows from the bottom, as in OpenGL.
#pragma once

#include "methods/kit/gpu/framebuffer.h"
#include "methods/kit/gpu/texture.h"

namespace dustbench::gpu {

class DUSTBENCH_API Layer {
 public:
    /// `sceneDepth` (Depth32F) must outlive the layer. `format`: rgba32F, or rgba16F if the user asks for it.
    Layer(Device& device, const Texture& sceneDepth, Format format = Format::rgba32F);

    void clear();
    /// Binds with the scene's depth attached: depth test on, depth writes off.
    void bindWithSceneDepth() const;
    /// Binds without a depth attachment, so that `sceneDepth()` may be sampled in the same pass.
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
