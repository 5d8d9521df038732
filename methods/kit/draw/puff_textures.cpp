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

using Texels = std::vector<glm::vec4>;

/// One frame's texels, premultiplied, rows from the bottom.
Texels frameOf(const pictures::Image& image, int frame) {
    const int edge = image.height;
    Texels texels;
    for (int y = edge - 1; y >= 0; --y)
        for (int x = 0; x < edge; ++x) texels.push_back(image.at(frame * edge + x, y));
    return texels;
}

struct Sums {
    double depth = 0, light = 0;
    std::size_t texels = 0;

    void add(const Texels& frame) {
        for (const glm::vec4& texel : frame) {
            depth += static_cast<double>(texel.a);
            light += luminance(glm::vec3(texel));  // premultiplied, so already weighted
        }
        texels += frame.size();
    }
};

/// From premultiplied texels to shading, of mean 1, and relative optical depth, of mean gaussianMean(); means of
/// `sums`.
void normalise(Texels& frame, const Sums& sums) {
    const auto depthScale = static_cast<float>(gaussianMean() * static_cast<double>(sums.texels) / sums.depth);
    const auto shadeScale = static_cast<float>(sums.depth / sums.light);
    for (glm::vec4& texel : frame) {
        const glm::vec3 shade = texel.a > 0 ? glm::vec3(texel) / texel.a : glm::vec3(1 / shadeScale);
        texel = {shade * shadeScale, texel.a * depthScale};
    }
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

    std::vector<Texels> layers;
    std::vector<Sums> sums;
    Sums sumOfAll;
    for (int frame = 0; frame < image.width / edge; ++frame) {
        layers.push_back(frameOf(image, frame));
        sums.emplace_back().add(layers.back());
        sumOfAll.add(layers.back());
        if (sums.back().depth <= 0 || sums.back().light <= 0)
            throw InputError("puff picture '" + file.string() + "': frame " + std::to_string(frame) +
                             " is empty, expected some colour and alpha");
    }
    for (std::size_t i = 0; i < layers.size(); ++i) normalise(layers[i], frames == Frames::looped ? sumOfAll : sums[i]);
    if (frames == Frames::looped) layers.push_back(layers.front());
    opticalDepthScale_ = shadeScale_ = 0;
    for (const Texels& layer : layers)
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
