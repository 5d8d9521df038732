#include "methods/adaptive_transparency/adaptive_transparency.h"

#include <algorithm>
#include <bit>
#include <map>
#include <string>

#include "adaptive_transparency_shaders.h"
#include "draw_shaders.h"
#include "methods/kit/gpu/layer.h"
#include "methods/kit/maths/transmittance.h"

namespace dustbench::adaptive_transparency {
namespace {

constexpr int tilePixels = 8;
constexpr int bitsPerNode = 2 * 32;  ///< depth and transmittance

/// A puff as the shader reads it.
struct PackedPuff {
    float x, y, z, deviation;  ///< metres
    float red, green, blue, opticalDepth;
};

}  // namespace

void AdaptiveTransparency::prepare(const scene::Scene&, const RunSetup&, gpu::Device& device) {
    device_ = &device;
    std::map<std::string, std::string> definitions{{"NODES", std::to_string(nodes_)}};
    if (puff_ == Puff::surface) definitions["SURFACE"] = "";
    using namespace adaptive_transparency_shaders;
    program_.emplace(
        device, "adaptive transparency",
        std::initializer_list<gpu::ShaderFile>{draw_shaders::error_function_glsl, draw_shaders::puff_ray_glsl,
                                               puff_tiles_glsl, visibility_glsl, composite_fragments_comp},
        definitions);
}

void AdaptiveTransparency::update(const Frame& frame) {
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

void AdaptiveTransparency::draw(const Frame& frame, gpu::Layer& layer) {
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

void AdaptiveTransparency::report(const Frame&, Facts& facts) const {
    facts.set("bits_per_pixel", static_cast<double>(nodes_ * bitsPerNode));
}

MethodInfo describe() {
    MethodInfo info;
    info.title = "Adaptive transparency";
    info.summary =
        "Builds the transmittance over depth of each pixel from a few nodes, and weights each fragment by it.";
    info.source = "SalviEtAl2011";
    info.takesLights = true;
    info.parameters
        .choice("puff", Puff::surface, puffKinds,
                "a puff as a surface at its centre's depth, as published, or as a volume cut by eye and scene, at the "
                "point on the ray nearest to its centre")
        .integer("nodes", 8, 2, 32, "nodes",
                 "nodes of a pixel's transmittance; pixels with at most this many fragments are blended in exact order")
        .real("reach", 3.5, 2, 6, "deviations",
              "radius of a puff in standard deviations; exp(-reach^2/2) of its depth is cut off");
    info.facts.push_back({"bits_per_pixel", "bit", FactOver::lastFrame,
                          "storage of the intermediate targets per pixel of the picture; of lists, the part in use"});
    info.create = [](const ParameterValues& values) {
        return std::make_unique<AdaptiveTransparency>(values.choice("puff", puffKinds), values.real("reach"),
                                                      static_cast<int>(values.integer("nodes")));
    };
    return info;
}

}  // namespace dustbench::adaptive_transparency
