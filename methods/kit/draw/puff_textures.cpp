#include "methods/kit/draw/puff_textures.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "methods/contract/errors.h"

namespace dustbench::draw {
namespace {

/// Mean of exp(−b²/2s²) over the quad of half-side 3s: (√(2π)·erf(3/√2)/6)².
double gaussianMean() {
    const double alongOneSide = std::sqrt(2 * std::numbers::pi) * std::erf(3 / std::numbers::sqrt2) / 6;
    return alongOneSide * alongOneSide;
}

double luminance(const glm::dvec3& colour) {
    return 0.2126 * colour.r + 0.7152 * colour.g + 0.0722 * colour.b;
}

/// One frame's texels, rows from the bottom: shading (mean 1) and relative optical depth (mean gaussianMean()).
std::vector<glm::vec4> normalisedFrame(const pictures::Image& image, int frame, const std::string& file) {
    const int edge = image.height;
    double depth = 0, light = 0;
    std::vector<glm::vec4> texels;
    for (int y = edge - 1; y >= 0; --y)
        for (int x = 0; x < edge; ++x) {
            const glm::vec4 texel = image.at(frame * edge + x, y);
            texels.push_back(texel);
            depth += static_cast<double>(texel.a);
            light += luminance(glm::vec3(texel));  // premultiplied, so already weighted
        }
    if (depth <= 0 || light <= 0)
        throw InputError("puff picture '" + file + "': frame " + std::to_string(frame) +
                         " is empty, expected some colour and alpha");
    const auto depthScale = static_cast<float>(gaussianMean() * static_cast<double>(texels.size()) / depth);
    const auto shadeScale = static_cast<float>(depth / light);
    for (glm::vec4& texel : texels) {
        const glm::vec3 shade = texel.a > 0 ? glm::vec3(texel) / texel.a : glm::vec3(1 / shadeScale);
        texel = {shade * shadeScale, texel.a * depthScale};
    }
    return texels;
}

std::uint8_t byteOf(float value, float scale) {
    return static_cast<std::uint8_t>(std::lround(255 * std::min(value / scale, 1.0f)));
}

}  // namespace

PuffTextures::PuffTextures(gpu::Device& device, const std::filesystem::path& file, Frames frames) : frames_(frames) {
    const pictures::Image image = pictures::readImage(file);
    const int edge = image.height;
    if (edge < 1 || image.width % edge != 0)
        throw InputError("puff picture '" + file.string() + "': got " + std::to_string(image.width) + "x" +
                         std::to_string(edge) + ", expected square frames side by side");

    std::vector<std::vector<glm::vec4>> layers;
    layers.reserve(static_cast<std::size_t>(image.width / edge));
    for (int frame = 0; frame < image.width / edge; ++frame)
        layers.push_back(normalisedFrame(image, frame, file.string()));
    opticalDepthScale_ = shadeScale_ = 0;
    for (const auto& layer : layers)
        for (const glm::vec4& texel : layer) {
            opticalDepthScale_ = std::max(opticalDepthScale_, texel.a);
            shadeScale_ = std::max({shadeScale_, texel.r, texel.g, texel.b});
        }

    texture_ = gpu::Texture::make2DArray(device, "puff pictures", gpu::Format::rgba8, edge, edge,
                                         static_cast<int>(layers.size()), gpu::Filter::mipmapped);
    for (std::size_t i = 0; i < layers.size(); ++i) {
        std::vector<std::uint8_t> bytes;
        for (const glm::vec4& texel : layers[i])
            bytes.insert(bytes.end(), {byteOf(texel.r, shadeScale_), byteOf(texel.g, shadeScale_),
                                       byteOf(texel.b, shadeScale_), byteOf(texel.a, opticalDepthScale_)});
        texture_.writeLayer(static_cast<int>(i), bytes);
    }
}

}  // namespace dustbench::draw
