#include "methods/kit/gpu/mip_levels.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "methods/kit/maths/srgb.h"

namespace dustbench::gpu {
namespace {

struct Light {
    int width = 0, height = 0;
    std::vector<float> values;
};

const std::array<float, 256>& decoded() {
    static const std::array<float, 256> table = [] {
        std::array<float, 256> result{};
        for (int code = 0; code < 256; ++code)
            result[static_cast<std::size_t>(code)] = maths::decodeSrgb(static_cast<float>(code) / 255);
        return result;
    }();
    return table;
}

/// The byte whose light is nearest in the encoding: the number of borders between two bytes that `light` exceeds.
std::uint8_t encoded(float light) {
    static const std::array<float, 255> borders = [] {
        std::array<float, 255> result{};
        for (int code = 0; code < 255; ++code)
            result[static_cast<std::size_t>(code)] = maths::decodeSrgb((static_cast<float>(code) + 0.5f) / 255);
        return result;
    }();
    return static_cast<std::uint8_t>(std::upper_bound(borders.begin(), borders.end(), light) - borders.begin());
}

/// Halves one side. `stride` values lie between neighbours along it, `lines` runs of neighbours follow each other.
/// An odd side of 2m + 1 texels becomes m: each covers 2 + 1/m of the old ones.
std::vector<float> halved(const std::vector<float>& from, int texels, std::size_t stride, std::size_t lines) {
    const int half = std::max(texels / 2, 1);
    const float width = static_cast<float>(texels) / static_cast<float>(half);
    std::vector<float> to(lines * static_cast<std::size_t>(half) * stride);
    for (std::size_t line = 0; line < lines; ++line)
        for (int i = 0; i < half; ++i) {
            const float begin = static_cast<float>(i) * width, end = begin + width;
            float* sum = &to[(line * static_cast<std::size_t>(half) + static_cast<std::size_t>(i)) * stride];
            const int last = std::min(static_cast<int>(std::ceil(end)), texels);
            for (int k = static_cast<int>(begin); k < last; ++k) {
                const float covered = std::min(end, static_cast<float>(k + 1)) - std::max(begin, static_cast<float>(k));
                const float weight = std::max(covered, 0.0f) / width;
                const float* value =
                    &from[(line * static_cast<std::size_t>(texels) + static_cast<std::size_t>(k)) * stride];
                for (std::size_t c = 0; c < stride; ++c) sum[c] += weight * value[c];
            }
        }
    return to;
}

MipLevel rounded(const Light& light, std::size_t channels, bool srgb) {
    MipLevel level{light.width, light.height, std::vector<std::uint8_t>(light.values.size())};
    for (std::size_t i = 0; i < light.values.size(); ++i)
        level.values[i] = srgb && i % channels < 3
                              ? encoded(light.values[i])
                              : static_cast<std::uint8_t>(std::lround(255 * std::clamp(light.values[i], 0.0f, 1.0f)));
    return level;
}

}  // namespace

std::vector<MipLevel> mipLevelsOf(std::span<const std::uint8_t> values, int width, int height, int channels,
                                  bool srgb) {
    const auto stride = static_cast<std::size_t>(channels);
    Light light{width, height, std::vector<float>(values.size())};
    for (std::size_t i = 0; i < values.size(); ++i)
        light.values[i] = srgb && i % stride < 3 ? decoded()[values[i]] : static_cast<float>(values[i]) / 255;
    std::vector<MipLevel> levels;
    while (light.width > 1 || light.height > 1) {
        light.values = halved(light.values, light.width, stride, static_cast<std::size_t>(light.height));
        light.width = std::max(light.width / 2, 1);
        light.values = halved(light.values, light.height, stride * static_cast<std::size_t>(light.width), 1);
        light.height = std::max(light.height / 2, 1);
        levels.push_back(rounded(light, stride, srgb));
    }
    return levels;
}

}  // namespace dustbench::gpu
