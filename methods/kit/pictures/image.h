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

/// Composites `layer` (premultiplied) over `scene`: C = L + (1 − α)·S. Throws std::invalid_argument for different
/// sizes.
[[nodiscard]] DUSTBENCH_API Image over(const Image& layer, const Image& scene);

/// Decodes an image from sRGB to linear light; alpha is unchanged.
[[nodiscard]] DUSTBENCH_API Image decoded(Image image);

/// Selects the format by extension: .png (8 bit, sRGB encoded) or .exr (float, linear). Writes a temporary file and
/// renames it, so that no partial file remains. Alpha is premultiplied here and in .exr, straight in .png, and omitted
/// from .png if the whole image is opaque. Throws InputError if the file cannot be written.
DUSTBENCH_API void writeImage(const Image& image, const std::filesystem::path& file);

/// The bytes of the .png that writeImage() writes.
[[nodiscard]] DUSTBENCH_API std::string encodedPng(const Image& image);

/// Reads any image that OpenImageIO can read, converted to linear. Throws InputError with file and reason.
[[nodiscard]] DUSTBENCH_API Image readImage(const std::filesystem::path& file);

}  // namespace dustbench::pictures
