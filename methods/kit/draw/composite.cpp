#include "methods/kit/draw/composite.h"

#include <stdexcept>

#include "draw_shaders.h"
#include "methods/kit/gpu/draw_call.h"
#include "methods/kit/gpu/framebuffer.h"

namespace dustbench::draw {

struct Composite::State {
    explicit State(gpu::Device& drawnBy)
        : device(drawnBy),
          program(device, "composite", {draw_shaders::composite_vert, draw_shaders::composite_frag}),
          noVertices(device) {}

    gpu::Device& device;
    gpu::Texture result;
    gpu::Framebuffer target;
    gpu::Program program;
    gpu::VertexArray noVertices;
};

Composite::Composite(gpu::Device& device, int width, int height) : state_(std::make_unique<State>(device)) {
    resize(width, height);
}

Composite::~Composite() = default;

void Composite::resize(int width, int height) {
    state_->result = gpu::Texture::make2D(state_->device, "composed image", gpu::Format::rgba8, width, height);
    state_->target = gpu::Framebuffer(state_->device, "composed image", &state_->result, nullptr);
}

void Composite::draw(const gpu::Texture& scene, const gpu::Texture& layer) {
    for (const gpu::Texture* texture : {&scene, &layer})
        if (texture->width() != result().width() || texture->height() != result().height())
            throw std::invalid_argument("Composite: scene, layer and result differ in size");
    state_->target.bind();
    scene.bind(0);
    layer.bind(1);
    gpu::draw(state_->program, state_->noVertices, {}, gpu::Primitives::triangles, 3);
}

const gpu::Texture& Composite::result() const {
    return state_->result;
}

}  // namespace dustbench::draw
