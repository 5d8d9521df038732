#include "methods/multi_layer/multi_layer.h"

#include <map>
#include <string>
#include <utility>
#include <vector>

#include "methods/kit/draw/cost_facts.h"
#include "multi_layer_shaders.h"

namespace dustbench::multi_layer {
namespace {

constexpr int bitsPerLayer = 5 * 32;  ///< colour, transmittance and depth

}  // namespace

void MultiLayer::prepare(const scene::Scene&, const RunSetup&, gpu::Device& device) {
    std::map<std::string, std::string> definitions{{"LAYERS", std::to_string(layers_)}};
    if (puff_ == Puff::surface) definitions["SURFACE"] = "";
    quads_.emplace(device, reach_);
    pass_.emplace(device, "multi_layer", std::vector<gpu::ShaderFile>{multi_layer_shaders::blend_layers_comp},
                  std::move(definitions), reach_);
}

void MultiLayer::update(const Frame& frame) {
    const auto timing = frame.clock.measure(Stage::upload);
    frame.gpuDust ? quads_->gather(*frame.gpuDust) : quads_->upload(frame.dust);
}

void MultiLayer::draw(const Frame& frame, gpu::Layer& layer) {
    if (quads_->count() == 0) return;
    pass_->run(*quads_, pass_->begin(*quads_, frame), layer);
}

void MultiLayer::report(const Frame&, Facts& facts) const {
    if (pass_) pass_->requireWholeLoops();
    facts.set("bits_per_pixel", static_cast<double>(layers_ * bitsPerLayer));
    facts.set("bytes_per_fragment", std::int64_t{0});
}

MemoryReport MultiLayer::memory() const {
    return {{"puffs", 0, quads_ ? quads_->gpuBytes() : 0}};
}

std::int64_t MultiLayer::primitives() const {
    return quads_ ? quads_->primitives() : 0;
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
    info.facts = {draw::bitsPerPixel(), draw::bytesPerFragment()};
    info.takesGpuDust = [](const ParameterValues&) { return true; };
    info.create = [](const ParameterValues& values) {
        return std::make_unique<MultiLayer>(values.choice("puff", puffKinds), values.real("reach"),
                                            static_cast<int>(values.integer("layers")));
    };
    return info;
}

}  // namespace dustbench::multi_layer
