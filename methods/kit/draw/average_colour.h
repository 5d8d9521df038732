// The last pass of methods that sum colours in any order: C = (Σ w·c)/(Σ w)·α, α = 1 − exp(−Σ depth).
//
// Owns: its program. Threads: the OpenGL thread. Colours: linear RGB, premultiplied.
// Source: McGuireBavoil2013, Eq. 6; Munstermann2018, 3. Departs: α from the sum of depths in place of a product.
#pragma once

#include "methods/kit/gpu/device.h"
#include "methods/kit/gpu/layer.h"
#include "methods/kit/gpu/program.h"
#include "methods/kit/gpu/texture.h"
#include "methods/kit/gpu/vertex_array.h"

namespace dustbench::draw {

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
