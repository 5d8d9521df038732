#include "bench/view/split_view.h"

#include <cmath>
#include <cstdint>
#include <stdexcept>
#include <vector>

#include "bench_view_shaders.h"
#include "methods/kit/gpu/draw_call.h"

namespace dustbench::view {
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

/// `values`, `count` of them to a row, with the last row first.
template <typename Value>
std::vector<Value> upsideDown(std::span<const Value> values, std::size_t count) {
    std::vector<Value> turned;
    turned.reserve(values.size());
    for (std::size_t end = values.size(); end >= count && count > 0; end -= count)
        turned.insert(turned.end(), values.begin() + static_cast<std::ptrdiff_t>(end - count),
                      values.begin() + static_cast<std::ptrdiff_t>(end));
    return turned;
}

std::vector<std::uint8_t> encoded(const pictures::Image& image) {
    std::vector<std::uint8_t> values;
    values.reserve(4 * image.pixels.size());
    for (const glm::vec4& pixel : image.pixels) {
        for (int channel = 0; channel < 3; ++channel)
            values.push_back(static_cast<std::uint8_t>(std::lround(255 * pictures::encodeSrgb(pixel[channel]))));
        values.push_back(255);
    }
    return values;
}

std::vector<float> flat(const pictures::Image& image) {
    std::vector<float> values;
    values.reserve(4 * image.pixels.size());
    for (const glm::vec4& pixel : image.pixels) values.insert(values.end(), {pixel.r, pixel.g, pixel.b, pixel.a});
    return values;
}

}  // namespace

PictureParts shownParts(const SplitSettings& settings) {
    const PicturePart both{settings.origin, settings.origin + settings.extent};
    if (settings.shown == Shown::difference || settings.shown == Shown::flip || settings.shown == Shown::sideBySide)
        return {both, both};
    PictureParts parts{both, both};
    parts[0].to.x = parts[1].from.x = settings.origin.x + settings.extent.x * dividerOf(settings);
    return parts;
}

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

void upload(const pictures::Image& image, gpu::Texture& texture) {
    const auto row = 4 * static_cast<std::size_t>(image.width);
    if (texture.format() == gpu::Format::rgba8) {
        const std::vector<std::uint8_t> values = upsideDown<std::uint8_t>(encoded(image), row);
        texture.write(std::span<const std::uint8_t>(values));
    } else {
        const std::vector<float> values = upsideDown<float>(flat(image), row);
        texture.write(std::span<const float>(values));
    }
}

void uploadRows(std::span<const float> values, gpu::Texture& texture) {
    const std::vector<float> turned = upsideDown<float>(values, static_cast<std::size_t>(texture.width()));
    texture.write(std::span<const float>(turned));
}

}  // namespace dustbench::view
