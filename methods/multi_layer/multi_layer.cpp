#include "methods/multi_layer/multi_layer.h"

#include <algorithm>
#include <bit>
#include <map>
#include <string>

#include "draw_shaders.h"
#include "methods/kit/gpu/layer.h"
#include "methods/kit/maths/transmittance.h"
#include "multi_layer_shaders.h"

namespace dustbench::multi_layer {
namespace {

constexpr int tilePixels = 8;
constexpr int bitsPerLayer = 5 * 32;  ///< colour, transmittance and depth

/// A puff as the shader reads it.
struct PackedPuff {
    float x, y, z, deviation;  ///< metres
    float red, green, blue, opticalDepth;
};

}  // namespace

void MultiLayer::prepare(const scene::Scene&, const RunSetup&, gpu::Device& device) {
    device_ = &device;
    std::map<std::string, std::string> definitions{{"LAYERS", std::to_string(layers_)}};
    if (puff_ == Puff::surface) definitions["SURFACE"] = "";
    program_.emplace(
        device, "multi-layer blending",
        std::initializer_list<gpu::ShaderFile>{draw_shaders::error_function_glsl, draw_shaders::puff_ray_glsl,
                                               multi_layer_shaders::blend_layers_comp},
        definitions);
}

void MultiLayer::update(const Frame& frame) {
    const auto timing = frame.clock.measure(Stage::upload);
    const Puffs& dust = frame.dust;
    count_ = dust.size();
    if (count_ == 0) return;
    const std::size_t bytes = count_ * sizeof(PackedPuff);
    if (puffs_.bytes() < bytes) puffs_ = gpu::Buffer(*device_, "puffs", std::bit_ceil(bytes));
    auto* packed = static_cast<PackedPuff*>(puffs_.mapForWriting(bytes));
    for (std::size_t i = 0; i < count_; ++i) {
        const glm::vec3 colour = dust.colour(i);
        const double deviation = maths::puffDeviationMetres(static_cast<double>(dust.radius[i]));
        const double depth = maths::puffOpticalDepth(static_cast<double>(dust.opacity[i]));
        packed[i] = {dust.x[i], dust.y[i], dust.z[i], static_cast<float>(deviation),
                     colour.r,  colour.g,  colour.b,  static_cast<float>(depth)};
    }
    puffs_.unmap();
}

void MultiLayer::draw(const Frame& frame, gpu::Layer& layer) {
    if (count_ == 0) return;
    const scene::View& view = frame.view;
    const glm::mat4 clip = view.eyeToClip();
    const glm::vec2 slopes(1 / clip[0][0], 1 / clip[1][1]);  // at the picture's edges
    program_->set("rays", glm::vec4(2.0f * slopes / glm::vec2(view.width, view.height), -slopes));
    program_->set("nearMetres", static_cast<float>(view.camera.nearMetres));
    program_->set("reach", static_cast<float>(reach_));
    program_->set("eye", glm::vec3(view.camera.eye));
    program_->set("worldToEye", view.worldToEye());
    program_->set("count", static_cast<int>(count_));
    puffs_.bindStorage(0);
    layer.sceneDepth().bind(0);
    layer.colour().bindImage(0, false, true);
    const auto tiles = [](int pixels) { return (pixels + tilePixels - 1) / tilePixels; };
    program_->dispatch(tiles(view.width), tiles(view.height), 1);
}

void MultiLayer::report(const Frame&, Facts& facts) const {
    facts.set("bits_per_pixel", static_cast<double>(layers_ * bitsPerLayer));
}

MethodInfo describe() {
    MethodInfo info;
    info.title = "Multi-layer alpha blending";
    info.summary =
        "Keeps a few layers per pixel, sorted by depth, and merges the two farthest when there are too many.";
    info.source = "SalviVaidyanathan2014";
    info.takesLights = true;
    info.parameters
        .choice("puff", Puff::surface, puffKinds,
                "a puff as a surface at its centre's depth, as published, or as a volume cut by eye and scene, at the "
                "point on the ray nearest to its centre")
        .integer("layers", 4, 1, 16, "layers",
                 "layers per pixel; pixels with at most this many fragments are blended in exact order")
        .real("reach", 3.5, 2, 6, "deviations",
              "radius of a puff in standard deviations; exp(-reach^2/2) of its depth is cut off");
    info.facts.push_back({"bits_per_pixel", "bit", FactOver::lastFrame,
                          "storage of the intermediate targets per pixel of the picture; of lists, the part in use"});
    info.create = [](const ParameterValues& values) {
        return std::make_unique<MultiLayer>(values.choice("puff", puffKinds), values.real("reach"),
                                            static_cast<int>(values.integer("layers")));
    };
    return info;
}

}  // namespace dustbench::multi_layer
