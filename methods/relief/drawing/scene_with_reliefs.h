// A picture of the reliefs and the dust in front of them. Its depth is the scene's, with the reliefs drawn into it.
//
// Owns: colour and depth. Threads: the OpenGL thread.
#pragma once

#include "methods/kit/gpu/device.h"
#include "methods/kit/gpu/framebuffer.h"
#include "methods/kit/gpu/layer.h"
#include "methods/kit/gpu/program.h"
#include "methods/kit/gpu/texture.h"
#include "methods/kit/gpu/vertex_array.h"

namespace dustbench::relief {

class SceneWithReliefs {
 public:
    SceneWithReliefs(gpu::Device& device, int width, int height);

    /// Clears the colour, copies the scene's depth and binds both for opaque drawing.
    void begin(const gpu::Texture& sceneDepth);
    /// The target for translucent drawing over everything drawn since `begin`.
    [[nodiscard]] const gpu::Layer& layer() const { return layer_; }
    /// Replaces the colour of `result`, which has the same size.
    void copyTo(gpu::Layer& result);

    [[nodiscard]] int width() const { return depth_.width(); }
    [[nodiscard]] int height() const { return depth_.height(); }
    [[nodiscard]] std::size_t gpuBytes() const { return depth_.bytes() + layer_.colour().bytes(); }

 private:
    gpu::Texture depth_;
    gpu::Layer layer_;
    gpu::Framebuffer opaque_;
    gpu::Program copyDepth_, copyColour_;
    gpu::VertexArray noVertices_;
};

}  // namespace dustbench::relief
