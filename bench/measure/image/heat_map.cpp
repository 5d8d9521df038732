#include "bench/measure/image/heat_map.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "bench/measure/image/colour_spaces.h"

namespace dustbench::measure {
namespace {

/// Chroma and hue (CIELAB, degrees) at equal steps of lightness. Chroma is the maximum in sRGB, rounded down.
struct Tint {
    float chroma, hueDegrees;
};
constexpr std::array<Tint, 9> tints{
    {{0, 300}, {34, 300}, {56, 315}, {64, 338}, {66, 363}, {66, 390}, {56, 418}, {44, 444}, {14, 460}}};
constexpr float darkest = 2, lightest = 96;  // L*

}  // namespace

glm::vec3 heatColour(float share) {
    const float position = std::clamp(share, 0.0f, 1.0f) * static_cast<float>(tints.size() - 1);
    const std::size_t step = std::min(static_cast<std::size_t>(position), tints.size() - 2);
    const float part = position - static_cast<float>(step);
    const Tint &a = tints[step], &b = tints[step + 1];
    const float chroma = a.chroma + part * (b.chroma - a.chroma);
    const float hue = (a.hueDegrees + part * (b.hueDegrees - a.hueDegrees)) * std::numbers::pi_v<float> / 180;
    const float lightness = darkest + std::clamp(share, 0.0f, 1.0f) * (lightest - darkest);
    return linearFromLab({lightness, chroma * std::cos(hue), chroma * std::sin(hue)});
}

pictures::Image heatMap(const Plane& map, float minimum, float maximum) {
    if (!(maximum > minimum)) throw std::invalid_argument("heatMap: `most` must be above `least`");
    pictures::Image image{map.width, map.height, {}};
    image.pixels.reserve(map.values.size());
    for (const float value : map.values)
        image.pixels.emplace_back(heatColour((value - minimum) / (maximum - minimum)), 1.0f);
    return image;
}

}  // namespace dustbench::measure
