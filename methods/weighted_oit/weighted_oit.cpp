#include "methods/weighted_oit/weighted_oit.h"

#include <string>

#include "weighted_oit_shaders.h"

namespace dustbench::weighted_oit {
namespace {

std::string equationOf(Weight weight) {
    switch (weight) {
        case Weight::eq7:
            return "7";
        case Weight::eq8:
            return "8";
        case Weight::eq9:
            return "9";
        case Weight::eq10:
            return "10";
        case Weight::none:
            return "5";
    }
    return "5";
}

}  // namespace

void WeightedOit::prepare(const scene::Scene&, const RunSetup&, gpu::Device& device) {
    quads_.emplace(device, reach_);
    sums_.emplace(device, "weighted sums", std::vector<gpu::Format>{gpu::Format::rgba32F, gpu::Format::r32F});
    average_.emplace(device);
    pass_ =
        draw::puffPass("weighted sums", {weighted_oit_shaders::weighted_sum_frag}, {{"WEIGHT", equationOf(weight_)}});
}

void WeightedOit::update(const Frame& frame) {
    const auto timing = frame.clock.measure(Stage::upload);
    quads_->upload(frame.dust);
}

void WeightedOit::draw(const Frame& frame, gpu::Layer& layer) {
    if (quads_->count() == 0) return;
    gpu::Program& program = quads_->begin(*pass_, frame.view);
    if (!quads_->isColoured()) program.set("puffColour", frame.dust.colourOfAll);
    sums_->begin(layer.width(), layer.height());
    quads_->add(program, layer.sceneDepth());
    average_->draw(sums_->texture(0), sums_->texture(1), layer);
}

MemoryReport WeightedOit::memory() const {
    MemoryReport report;
    if (quads_) report.push_back({"puffs", 0, quads_->gpuBytes()});
    if (sums_) report.push_back({"weighted sums", 0, sums_->gpuBytes()});
    return report;
}

std::int64_t WeightedOit::primitives() const {
    return quads_ ? static_cast<std::int64_t>(quads_->count()) : 0;
}

MethodInfo describe() {
    MethodInfo info;
    info.title = "Weighted blended OIT";
    info.summary =
        "Adds up puffs in any order, weighted by distance; the cloud's alpha is exact, different colours are mixed.";
    info.source = "McGuireBavoil2013";
    info.takesLights = true;
    info.parameters
        .choice("weight", Weight::eq7, weights,
                "decrease of a puff's weight with its distance: an equation of the paper, or none")
        .real("reach", 3.5, 2, 6, "deviations",
              "half-side of a puff's quad in standard deviations; exp(-reach^2/2) of its depth is cut off");
    info.create = [](const ParameterValues& values) {
        return std::make_unique<WeightedOit>(values.choice("weight", weights), values.real("reach"));
    };
    return info;
}

}  // namespace dustbench::weighted_oit
