#include "methods/kit/gpu/layer.h"

namespace dustbench::gpu {

Layer::Layer(Device& device, const Texture& sceneDepth, Format format)
    : sceneDepth_(sceneDepth),
      colour_(Texture::make2D(device, "method layer", format, sceneDepth.width(), sceneDepth.height())),
      withDepth_(device, "method layer over the scene's depth", &colour_, &sceneDepth),
      colourOnly_(device, "method layer", &colour_, nullptr) {}

void Layer::clear() {
    colourOnly_.clearColour(0, 0, 0, 0);
}

void Layer::bindWithSceneDepth() const {
    withDepth_.bind();
}

void Layer::bindColourOnly() const {
    colourOnly_.bind();
}

}  // namespace dustbench::gpu
