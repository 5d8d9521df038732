#include "bench/view/split_view.h"

#include <stdexcept>

#include "bench_view_shaders.h"
#include "methods/kit/gpu/draw_call.h"

namespace dustbench::bench {
namespace {

float dividerOf(const SplitSettings& settings) {
    if (settings.shown == Shown::a) return 1;
    return settings.shown == Shown::b ? 0 : settings.divider;
}

}  // namespace

SplitView::SplitView(gpu::Device& device)
    : program_(device, "split view", {bench_view_shaders::split_view_vert, bench_view_shaders::split_view_frag}),
      noVertices_(device) {}

void SplitView::draw(const gpu::Texture& a, const gpu::Texture& b, const SplitSettings& settings,
                     const gpu::Framebuffer& target, int width, int height) {
    if (a.width() != b.width() || a.height() != b.height())
        throw std::invalid_argument("SplitView: the two pictures differ in size");
    target.bind();
    a.bind(0);
    b.bind(1);
    program_.set("region", glm::vec4(settings.origin, settings.extent));
    program_.set("size", glm::vec2(width, height));
    program_.set("divider", dividerOf(settings));
    program_.set("gain", settings.shown == Shown::difference ? settings.gain : 0.0f);
    gpu::draw(program_, noVertices_, {}, gpu::Primitives::triangles, 3);
}

}  // namespace dustbench::bench
