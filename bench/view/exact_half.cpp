#include "bench/view/exact_half.h"

#include "bench/measure/clock.h"
#include "bench/view/image_upload.h"
#include "methods/contract/errors.h"

namespace dustbench::bench {
namespace {

pictures::Image opaque(pictures::Image image) {
    for (glm::vec4& pixel : image.pixels) pixel.a = 1;
    return image;
}

}  // namespace

ExactHalf::ExactHalf(gpu::Device& device, int width, int height)
    : display_(gpu::Texture::make2D(device, "ground truth", gpu::Format::rgba8, width, height)),
      scene_(gpu::Texture::make2D(device, "scene of the ground truth", gpu::Format::rgba32F, width, height)),
      layer_(gpu::Texture::make2D(device, "layer of the ground truth", gpu::Format::rgba32F, width, height)),
      depth_(gpu::Texture::make2D(device, "depth of the ground truth", gpu::Format::r32F, width, height)) {}

void ExactHalf::draw(const DrawnMoment& drawn, const scene::Scene& scene, const scene::View& view, const Puffs& dust,
                     std::string whyNotEvaluated) {
    const std::int64_t start = steadyNow();
    ReferenceStore none;
    const ExactMoment exact = exactMoment(scene, view, drawn, dust, false, std::nullopt, none);
    whyNotEvaluated_ = std::move(whyNotEvaluated);
    evaluated_ = {
        {}, opaque(pictures::over(drawn.layer, drawn.scene)), opaque(pictures::over(exact.layer, drawn.scene)), {}};
    try {
        if (whyNotEvaluated_.empty()) evaluated_ = comparePictures(drawn, exact);
    } catch (const InputError& error) {  // the picture contains values that are not finite
        whyNotEvaluated_ = error.what();
    }
    upload(evaluated_.reference, display_);
    upload(drawn.scene, scene_);
    upload(exact.layer, layer_);
    uploadRows(drawn.sceneDepth, depth_);
    seconds_ = static_cast<double>(steadyNow() - start) / 1e9;
}

}  // namespace dustbench::bench
