// Sums of colours in any order: the textures that passes blend into, and the pass that makes an average of them.
//
// Threads: the OpenGL thread.
#pragma once

#include <string>
#include <vector>

#include "methods/kit/gpu/device.h"
#include "methods/kit/gpu/draw_call.h"
#include "methods/kit/gpu/framebuffer.h"
#include "methods/kit/gpu/layer.h"
#include "methods/kit/gpu/program.h"
#include "methods/kit/gpu/texture.h"

namespace dustbench::draw {

/// Textures of one size, with a framebuffer for all of them. Owns the textures.
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

/// The last pass of methods that sum colours: C = (Σ w·c)/(Σ w)·α, α = 1 − exp(−Σ depth). Colours are linear RGB,
/// premultiplied. Owns its program.
///
/// Source: McGuireBavoil2013, Eq. 6; Munstermann2018, 3. Departs: α from the sum of depths in place of a product.
class DUSTBENCH_API AverageColour {
 public:
    explicit AverageColour(gpu::Device& device);

    /// `colours`: Σ w·c and Σ w; `depths`: Σ depth in the first channel. Both have the size of the layer.
    void draw(const gpu::Texture& colours, const gpu::Texture& depths, const gpu::Layer& layer);

 private:
    gpu::Program program_;
    gpu::VertexArray noVertices_;
};

}  // namespace dustbench::draw
