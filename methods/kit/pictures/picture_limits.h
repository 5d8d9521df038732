// Which pictures are too large to read, by what their header says. Linked into both picture libraries as code alone.
#pragma once

#include <cstdint>
#include <string>

#include "methods/kit/files/limits.h"

namespace dustbench::pictures {

/// Empty if the pixels, as floats, are within the limits, else the reason.
[[nodiscard]] inline std::string tooLarge(std::int64_t width, std::int64_t height, std::int64_t channels) {
    namespace limits = files::limits;
    const std::string size = std::to_string(width) + " x " + std::to_string(height) + " pixels";
    if (width > limits::imageEdge || height > limits::imageEdge)
        return "it has " + size + ", allowed: " + std::to_string(limits::imageEdge) + " a side (limit of images)";
    const auto bytes = static_cast<std::uintmax_t>(width * height * channels) * sizeof(float);
    if (bytes > limits::imageBytes)
        return "it has " + size + " of " + std::to_string(channels) +
               " channels, allowed: 1 GB decoded (limit of images)";
    return "";
}

}  // namespace dustbench::pictures
