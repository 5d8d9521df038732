// Rejects pictures that are too large, by their headers. Both picture libraries compile this code.
#pragma once

#include <cstdint>
#include <string>

#include "methods/kit/files/limits.h"

namespace dustbench::pictures {

/// Empty if the pixels, as floats, are within the limits; otherwise the reason.
[[nodiscard]] inline std::string tooLarge(std::int64_t width, std::int64_t height, std::int64_t channels) {
    namespace limits = files::limits;
    const std::string size = std::to_string(width) + " x " + std::to_string(height) + " pixels";
    if (width > limits::imageEdge || height > limits::imageEdge)
        return "it has " + size + ", allowed: " + std::to_string(limits::imageEdge) + " per side (limit of images)";
    const auto bytes = static_cast<std::uintmax_t>(width * height * channels) * sizeof(float);
    if (bytes > limits::imageBytes)
        return "it has " + size + " of " + std::to_string(channels) +
               " channels, allowed: 1 GB decoded (limit of images)";
    return "";
}

}  // namespace dustbench::pictures
