#include "bench/view/split_view.h"

#include <cmath>
#include <stdexcept>

#include "bench_view_shaders.h"
#include "methods/kit/gpu/draw_call.h"

namespace dustbench::bench {
namespace {

/// Numbers of the shader's `source`.
enum class Source { display = 0, light = 1, alpha = 2, depth = 3, faults = 4 };

float dividerOf(const SplitSettings& settings) {
    if (settings.shown == Shown::a || settings.shown == Shown::flip) return 1;  // one picture, no line
    return settings.shown == Shown::b ? 0 : settings.divider;
}

Source sourceOf(const SplitSettings& settings) {
    if (settings.shown == Shown::flip) return Source::display;
    switch (settings.channel) {
        case Channel::alpha:
            return Source::alpha;
        case Channel::depth:
            return Source::depth;
        case Channel::faults:
            return Source::faults;
        case Channel::overdraw:
        case Channel::outlines:
            return Source::display;
        case Channel::picture:
            break;
    }
    return settings.encoded && settings.stops == 0 ? Source::display : Source::light;
}

}  // namespace

SplitView::SplitView(gpu::Device& device)
    : program_(device, "split view", {bench_view_shaders::split_view_vert, bench_view_shaders::split_view_frag}),
      noVertices_(device) {}

void SplitView::draw(const HalfTextures& a, const HalfTextures& b, const SplitSettings& settings, double nearMetres,
                     const gpu::Framebuffer& target, int width, int height) {
    if (a.display.width() != b.display.width() || a.display.height() != b.display.height())
        throw std::invalid_argument("SplitView: the two pictures differ in size");
    target.bind();
    std::uint32_t unit = 0;
    for (const HalfTextures* half : {&a, &b})
        for (const gpu::Texture* texture : {&half->display, &half->scene, &half->layer, &half->depth})
            texture->bind(unit++);
    program_.set("region", glm::vec4(settings.origin, settings.extent));
    program_.set("size", glm::vec2(width, height));
    program_.set("divider", dividerOf(settings));
    program_.set("sideBySide", settings.shown == Shown::sideBySide ? 1 : 0);
    program_.set("gain", settings.shown == Shown::difference ? settings.gain : 0.0f);
    program_.set("source", static_cast<int>(sourceOf(settings)));
    program_.set("exposure", std::exp2(settings.stops));
    program_.set("encoded", settings.encoded ? 1 : 0);
    program_.set("interpolated", a.display.height() < height ? 1 : 0);
    program_.set("nearMetres", static_cast<float>(nearMetres));
    gpu::draw(program_, noVertices_, {}, gpu::Primitives::triangles, 3);
}

}  // namespace dustbench::bench
