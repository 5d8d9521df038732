#include "methods/kit/draw/average_colour.h"

#include "draw_shaders.h"
#include "methods/kit/gpu/draw_call.h"

namespace dustbench::draw {

AverageColour::AverageColour(gpu::Device& device)
    : program_(device, "average colour", {draw_shaders::composite_vert, draw_shaders::average_colour_frag}),
      noVertices_(device) {}

void AverageColour::draw(const gpu::Texture& colours, const gpu::Texture& depths, const gpu::Layer& layer) {
    layer.bindColourOnly();
    colours.bind(0);
    depths.bind(1);
    gpu::draw(program_, noVertices_, {}, gpu::Primitives::triangles, 3);
}

}  // namespace dustbench::draw
