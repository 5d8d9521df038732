// An image in memory: linear RGBA floats, rows from the top.
#pragma once

#include <filesystem>
#include <glm/glm.hpp>
#include <vector>

#include "methods/kit/maths/srgb.h"

namespace dustbench::pictures {

struct Image {
    int width = 0;
    int height = 0;
    std::vector<glm::vec4> pixels;

    [[nodiscard]] const glm::vec4& at(int x, int y) const {
        return pixels[static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x)];
    }
};

using maths::decodeSrgb;
using maths::encodeSrgb;

/// `layer` (premultiplied) over `scene`: C = L + (1 − α)·S. Throws std::invalid_argument for different sizes.
[[nodiscard]] DUSTBENCH_API Image over(const Image& layer, const Image& scene);

/// By extension: .png (8 bit, sRGB encoded) or .exr (float, linear). Written beside and renamed, so never half there.
/// Alpha is premultiplied here and in .exr, straight in .png, which leaves it out where the whole image is opaque.
/// Throws InputError where the file cannot be written.
DUSTBENCH_API void writeImage(const Image& image, const std::filesystem::path& file);

/// Any image that OpenImageIO reads, made linear. Throws InputError with file and reason.
[[nodiscard]] DUSTBENCH_API Image readImage(const std::filesystem::path& file);

}  // namespace dustbench::pictures
