#include "methods/kit/draw/layer_blend.h"

#include <limits>
#include <stdexcept>

#include "draw_shaders.h"
#include "methods/kit/gpu/draw_call.h"
#include "methods/kit/gpu/framebuffer.h"

namespace dustbench::draw {
namespace {

constexpr float unlimited = std::numeric_limits<float>::max();

/// Rec. 709 luminance of the source in one channel, and half of its alpha.
glm::mat4 eyeMixing(int channel) {
    glm::mat4 mixing(0);
    mixing[0][channel] = 0.2126f;
    mixing[1][channel] = 0.7152f;
    mixing[2][channel] = 0.0722f;
    mixing[3][3] = 0.5f;
    return mixing;
}

bool isLike(const gpu::Layer& layer, const gpu::Layer& other) {
    return &layer.sceneDepth() == &other.sceneDepth() && layer.width() == other.width() &&
           layer.height() == other.height() && layer.colour().format() == other.colour().format();
}

}  // namespace

LayerBlend::LayerBlend(gpu::Device& device)
    : program_(device, "layer blend", {draw_shaders::composite_vert, draw_shaders::layer_blend_frag}),
      noVertices_(device) {}

void LayerBlend::over(const gpu::Texture& source, const gpu::Layer& target) {
    blend(source, target, glm::mat4(1), unlimited, gpu::Blend::premultiplied);
}

void LayerBlend::add(const gpu::Texture& source, const gpu::Layer& target, float weight, bool clamped) {
    blend(source, target, glm::mat4(weight), clamped ? 1 : unlimited, gpu::Blend::additive);
}

void LayerBlend::addEye(const gpu::Texture& source, const gpu::Layer& target, Eye eye) {
    blend(source, target, eyeMixing(eye == Eye::left ? 1 : 0), unlimited, gpu::Blend::additive);
}

void LayerBlend::blend(const gpu::Texture& source, const gpu::Layer& target, const glm::mat4& mixing, float limit,
                       gpu::Blend blend) {
    if (source.width() != target.width() || source.height() != target.height())
        throw std::invalid_argument("LayerBlend: source and target differ in size");
    target.bindColourOnly();
    source.bind(0);
    program_.set("mixing", mixing);
    program_.set("limit", limit);
    gpu::DrawState state;
    state.blend = blend;
    gpu::draw(program_, noVertices_, state, gpu::Primitives::triangles, 3);
}

gpu::Layer& OwnLayer::clearedLike(const gpu::Layer& target) {
    const std::uint32_t depthName = target.sceneDepth().name().get();
    if (!layer_ || !isLike(*layer_, target) || depthName != depthName_)
        layer_.emplace(*device_, target.sceneDepth(), target.colour().format());
    depthName_ = depthName;
    layer_->clear();
    return *layer_;
}

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
