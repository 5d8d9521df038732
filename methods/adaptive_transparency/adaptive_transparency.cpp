#include "methods/adaptive_transparency/adaptive_transparency.h"

#include <map>
#include <string>
#include <utility>
#include <vector>

#include "adaptive_transparency_shaders.h"
#include "methods/kit/draw/cost_facts.h"

namespace dustbench::adaptive_transparency {
namespace {

constexpr int bitsPerNode = 2 * 32;  ///< depth and transmittance

}  // namespace

void AdaptiveTransparency::prepare(const scene::Scene&, const RunSetup&, gpu::Device& device) {
    std::map<std::string, std::string> definitions{{"NODES", std::to_string(nodes_)}};
    if (puff_ == Puff::surface) definitions["SURFACE"] = "";
    quads_.emplace(device, reach_);
    pass_.emplace(device, "adaptive_transparency",
                  std::vector<gpu::ShaderFile>{adaptive_transparency_shaders::visibility_glsl,
                                               adaptive_transparency_shaders::composite_fragments_comp},
                  std::move(definitions), reach_);
}

void AdaptiveTransparency::update(const Frame& frame) {
    const auto timing = frame.clock.measure(Stage::upload);
    frame.gpuDust ? quads_->gather(*frame.gpuDust) : quads_->upload(frame.dust);
}

void AdaptiveTransparency::draw(const Frame& frame, gpu::Layer& layer) {
    if (quads_->count() == 0) return;
    pass_->run(*quads_, pass_->begin(*quads_, frame), layer);
}

void AdaptiveTransparency::report(const Frame&, Facts& facts) const {
    if (pass_) pass_->requireWholeLoops();
    facts.set("bits_per_pixel", static_cast<double>(nodes_ * bitsPerNode));
    facts.set("bytes_per_fragment", std::int64_t{0});
}

MemoryReport AdaptiveTransparency::memory() const {
    return {{"puffs", 0, quads_ ? quads_->gpuBytes() : 0}};
}

std::int64_t AdaptiveTransparency::primitives() const {
    return quads_ ? quads_->primitives() : 0;
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
    info.facts = {draw::bitsPerPixel(), draw::bytesPerFragment()};
    info.takesGpuDust = [](const ParameterValues&) { return true; };
    info.create = [](const ParameterValues& values) {
        return std::make_unique<AdaptiveTransparency>(values.choice("puff", puffKinds), values.real("reach"),
                                                      static_cast<int>(values.integer("nodes")));
    };
    return info;
}

}  // namespace dustbench::adaptive_transparency
