#include "methods/relief/drawing/scene_with_reliefs.h"

#include "methods/kit/gpu/draw_call.h"
#include "relief_drawing_shaders.h"

namespace dustbench::relief {

SceneWithReliefs::SceneWithReliefs(gpu::Device& device, int width, int height)
    : depth_(gpu::Texture::make2D(device, "scene depth with reliefs", gpu::Format::depth32F, width, height)),
      layer_(device, depth_),
      opaque_(device, "scene with reliefs", &layer_.colour(), &depth_),
      copyDepth_(device, "copy depth",
                 {relief_drawing_shaders::whole_picture_vert, relief_drawing_shaders::copy_depth_frag}),
      copyColour_(device, "copy colour",
                  {relief_drawing_shaders::whole_picture_vert, relief_drawing_shaders::copy_colour_frag}),
      noVertices_(device) {}

void SceneWithReliefs::begin(const gpu::Texture& sceneDepth) {
    opaque_.bind();
    sceneDepth.bind(0);
    gpu::draw(copyDepth_, noVertices_, {.depthWrite = true}, gpu::Primitives::triangles, 3);
}

void SceneWithReliefs::copyTo(gpu::Layer& result) {
    result.bindColourOnly();
    layer_.colour().bind(0);
    gpu::draw(copyColour_, noVertices_, {}, gpu::Primitives::triangles, 3);
}

}  // namespace dustbench::relief
