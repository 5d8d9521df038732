#include "bench/run/finite_picture.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "methods/contract/errors.h"

namespace dustbench::bench {
namespace {

constexpr std::array<std::string_view, 4> channels{"red", "green", "blue", "alpha"};

/// The first channel that is not finite, or the number of channels.
std::size_t brokenChannel(const glm::vec4& pixel) {
    std::size_t channel = 0;
    while (channel < channels.size() && std::isfinite(pixel[static_cast<int>(channel)])) ++channel;
    return channel;
}

}  // namespace

void requireFinite(const pictures::Image& picture, std::int64_t frame, Stage stage, std::string_view what) {
    const auto isBroken = [](const glm::vec4& pixel) { return brokenChannel(pixel) < channels.size(); };
    const auto first = std::ranges::find_if(picture.pixels, isBroken);
    if (first == picture.pixels.end()) return;
    const auto index = first - picture.pixels.begin();
    const std::size_t channel = brokenChannel(*first);
    throw SimulationError(fmt::format(
        "frame {}: {} is not finite in {} pixels, first in ({}, {}): {} is {} (stage {})", frame, what,
        std::ranges::count_if(picture.pixels, isBroken), index % picture.width, index / picture.width,
        channels[channel], (*first)[static_cast<int>(channel)], stageNames[static_cast<std::size_t>(stage)]));
}

}  // namespace dustbench::bench
