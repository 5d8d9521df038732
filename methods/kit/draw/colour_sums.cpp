#include "methods/kit/draw/colour_sums.h"

#include <utility>

#include "draw_shaders.h"

namespace dustbench::draw {

SumTargets::SumTargets(gpu::Device& device, std::string label, std::vector<gpu::Format> formats,
                       std::vector<float> initial)
    : device_(&device), label_(std::move(label)), formats_(std::move(formats)), initial_(std::move(initial)) {
    initial_.resize(formats_.size(), 0);
}

void SumTargets::begin(int width, int height) {
    if (textures_.empty() || textures_.front().width() != width || textures_.front().height() != height) {
        std::vector<gpu::Texture> textures;
        std::vector<const gpu::Texture*> colours;
        textures.reserve(formats_.size());
        for (const gpu::Format format : formats_) {
            textures.push_back(gpu::Texture::make2D(*device_, label_, format, width, height));
            colours.push_back(&textures.back());
        }
        framebuffer_ = gpu::Framebuffer(*device_, label_, std::span<const gpu::Texture* const>(colours));
        textures_ = std::move(textures);
    }
    for (std::size_t i = 0; i < initial_.size(); ++i) framebuffer_.clearOutput(static_cast<int>(i), initial_[i]);
    framebuffer_.bind();
}

std::size_t SumTargets::gpuBytes() const {
    std::size_t bytes = 0;
    for (const gpu::Texture& texture : textures_) bytes += texture.bytes();
    return bytes;
}

AverageColour::AverageColour(gpu::Device& device)
    : program_(device, "average colour", {draw_shaders::composite_vert, draw_shaders::average_colour_frag}),
      noVertices_(device) {}

void AverageColour::draw(const gpu::Texture& colours, const gpu::Texture& depths, const gpu::Layer& layer) {
    layer.bindColourOnly();
    colours.bind(0);
    depths.bind(1);
    gpu::draw(program_, noVertices_, {}, gpu::Primitives::triangles, 3);
}

}  // namespace dustbench::draw
