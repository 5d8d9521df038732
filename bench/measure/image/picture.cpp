#include "bench/measure/image/picture.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "methods/contract/errors.h"
#include "methods/kit/parallel/for_each_block.h"

namespace dustbench::measure {
namespace {

/// Throws if `isBad(index)` holds for any pixel; reports how many, and the first.
template <typename IsBad>
void refuse(int width, int height, std::size_t pixels, std::string_view name, std::string_view what,
            const IsBad& isBad) {
    if (width < 1 || height < 1 || pixels != static_cast<std::size_t>(width) * static_cast<std::size_t>(height))
        throw InputError(
            fmt::format("{}: got {}x{} with {} pixels, expected width times height pixels, and at least "
                        "one",
                        name, width, height, pixels));
    std::size_t bad = 0, first = 0;
    for (std::size_t i = 0; i < pixels; ++i) {
        if (!isBad(i)) continue;
        if (bad++ == 0) first = i;
    }
    if (bad == 0) return;
    const auto row = static_cast<std::size_t>(width);
    throw InputError(fmt::format("{}: {} {} {}, the first at ({}, {})", name, bad, bad == 1 ? "pixel is" : "pixels are",
                                 what, first % row, first / row));
}

bool isFinite(const glm::vec4& pixel) {
    return std::isfinite(pixel.r) && std::isfinite(pixel.g) && std::isfinite(pixel.b) && std::isfinite(pixel.a);
}

}  // namespace

Picture preparePicture(const pictures::Image& image, const std::string& name) {
    requireFinite(image, name);
    requireOpaque(image, name);
    Picture picture{name, image.width, image.height, {}, {}, Plane(image.width, image.height)};
    picture.linear.fill(picture.luma);
    picture.encoded.fill(picture.luma);
    parallel::forEachBlock(image.pixels.size(), 4096, [&](std::size_t first, std::size_t count) {
        for (std::size_t i = first; i < first + count; ++i) {
            for (std::size_t channel = 0; channel < 3; ++channel) {
                const float value = image.pixels[i][static_cast<int>(channel)];
                picture.linear[channel].values[i] = value;
                picture.encoded[channel].values[i] = maths::encodeSrgb(value);
            }
            picture.luma.values[i] = 0.2126f * picture.encoded[0].values[i] + 0.7152f * picture.encoded[1].values[i] +
                                     0.0722f * picture.encoded[2].values[i];
        }
    });
    return picture;
}

void requireSameSize(const Picture& picture, const Picture& other) {
    requireSameSize(picture.width, picture.height, picture.name, other.width, other.height, other.name);
}

void requireFinite(const pictures::Image& image, std::string_view name) {
    refuse(image.width, image.height, image.pixels.size(), name, "not finite",
           [&](std::size_t i) { return !isFinite(image.pixels[i]); });
}

void requireFinite(const Plane& plane, std::string_view name) {
    refuse(plane.width, plane.height, plane.values.size(), name, "not finite",
           [&](std::size_t i) { return !std::isfinite(plane.values[i]); });
}

void requireOpaque(const pictures::Image& image, std::string_view name) {
    refuse(image.width, image.height, image.pixels.size(), name, "not opaque (expected alpha 1)",
           [&](std::size_t i) { return !(std::abs(image.pixels[i].a - 1) <= alphaTolerance); });
}

void requireSameSize(int width, int height, std::string_view name, int otherWidth, int otherHeight,
                     std::string_view otherName) {
    if (width != otherWidth || height != otherHeight)
        throw InputError(fmt::format("images differ in size: {} has {}x{}, {} has {}x{}", name, width, height,
                                     otherName, otherWidth, otherHeight));
}

void requireSameSize(const Plane& plane, std::string_view name, const Plane& other, std::string_view otherName) {
    requireSameSize(plane.width, plane.height, name, other.width, other.height, otherName);
}

Plane alphaOf(const pictures::Image& layer, std::string_view name) {
    requireFinite(layer, name);
    refuse(layer.width, layer.height, layer.pixels.size(), name, "outside alpha 0..1", [&](std::size_t i) {
        return layer.pixels[i].a < -alphaTolerance || layer.pixels[i].a > 1 + alphaTolerance;
    });
    Plane alpha(layer.width, layer.height);
    for (std::size_t i = 0; i < alpha.values.size(); ++i) alpha.values[i] = std::clamp(layer.pixels[i].a, 0.0f, 1.0f);
    return alpha;
}

}  // namespace dustbench::measure
