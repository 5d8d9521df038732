#include "methods/moment_oit/moment_oit.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <string>

#include "methods/kit/maths/transmittance.h"
#include "moment_oit_shaders.h"

namespace dustbench::moment_oit {
namespace {

std::map<std::string, std::string> definitionsOf(const Settings& settings) {
    std::map<std::string, std::string> names{{"MOMENTS", std::to_string(settings.moments)},
                                             {"SAMPLES", std::to_string(settings.samples)}};
    if (settings.warp == Warp::log) names["WARP_LOG"] = "";
    if (settings.shape == Shape::point) names["POINTS"] = "";
    return names;
}

/// Offset and factor of the shaders' `warped`: it subtracts x, then multiplies by y.
glm::vec2 warpUniform(const WarpedDepth& depth) {
    const double from = depth.warp == Warp::log ? std::log(depth.nearestMetres) : depth.nearestMetres;
    const double to = depth.warp == Warp::log ? std::log(depth.farthestMetres) : depth.farthestMetres;
    return {from, 2 / (to - from)};
}

}  // namespace

WarpedDepth depthRange(const Puffs& dust, const scene::View& view, Warp warp) {
    constexpr double deviations = 3;
    const glm::dvec3 eye = view.camera.eye, ahead = glm::normalize(view.camera.target - eye);
    double nearest = std::numeric_limits<double>::infinity(), farthest = 0;
    for (std::size_t i = 0; i < dust.size(); ++i) {
        const glm::dvec3 centre = glm::dvec3(dust.position(i)) - eye;
        const double reach = deviations * maths::puffDeviationMetres(static_cast<double>(dust.radius[i]));
        if (glm::dot(centre, ahead) < -reach) continue;
        nearest = std::min(nearest, glm::length(centre) - reach);
        farthest = std::max(farthest, glm::length(centre) + reach);
    }
    nearest = std::max(nearest < farthest ? nearest : 0, view.camera.nearMetres);
    return {warp, nearest, std::max(farthest, 1.01 * nearest)};
}

void MomentOit::prepare(const scene::Scene&, const RunSetup&, gpu::Device& device) {
    const auto definitions = definitionsOf(settings_);
    quads_.emplace(device, settings_.reachDeviations);
    moments_.emplace(device, "moments",
                     std::vector<gpu::Format>{gpu::Format::rgba32F,
                                              settings_.moments == 4 ? gpu::Format::r32F : gpu::Format::rgba32F});
    colours_.emplace(device, "weighted colours", std::vector<gpu::Format>{gpu::Format::rgba32F});
    average_.emplace(device);
    using namespace moment_oit_shaders;
    momentPass_ = draw::puffPass("moments", {moments_glsl, moment_sum_frag}, definitions);
    colourPass_ =
        draw::puffPass("colours by moments", {moments_glsl, transmittance_glsl, moment_colour_frag}, definitions);
}

void MomentOit::update(const Frame& frame) {
    const auto timing = frame.clock.measure(Stage::upload);
    quads_->upload(frame.dust);
}

void MomentOit::draw(const Frame& frame, gpu::Layer& layer) {
    if (quads_->count() == 0) return;
    const glm::vec2 warp = warpUniform(depthRange(frame.dust, frame.view, settings_.warp));
    gpu::Program& first = quads_->begin(*momentPass_, frame.view);
    first.set("warp", warp);
    moments_->begin(layer.width(), layer.height());
    quads_->add(first, layer.sceneDepth());

    gpu::Program& second = quads_->begin(*colourPass_, frame.view);
    second.set("warp", warp);
    second.set("momentBias", static_cast<float>(settings_.biasFactor * biasOf(settings_.moments)));
    second.set("overestimation", static_cast<float>(settings_.overestimation));
    if (!quads_->isColoured()) second.set("puffColour", frame.dust.colourOfAll);
    colours_->begin(layer.width(), layer.height());
    moments_->texture(0).bind(1);
    moments_->texture(1).bind(2);
    quads_->add(second, layer.sceneDepth());
    average_->draw(colours_->texture(0), moments_->texture(1), layer);
}

MemoryReport MomentOit::memory() const {
    MemoryReport report;
    if (quads_) report.push_back({"puffs", 0, quads_->gpuBytes()});
    if (moments_) report.push_back({"moments", 0, moments_->gpuBytes()});
    if (colours_) report.push_back({"weighted colours", 0, colours_->gpuBytes()});
    return report;
}

std::int64_t MomentOit::primitives() const {
    return quads_ ? 2 * static_cast<std::int64_t>(quads_->count()) : 0;  // two passes
}

MethodInfo describe() {
    MethodInfo info;
    info.title = "Moment-based OIT";
    info.summary =
        "Adds up puffs in any order in two passes: moments of the depth along each ray, then colours weighted by "
        "transmittance.";
    info.source = "Munstermann2018";
    info.takesLights = true;
    info.parameters.choice("moments", "6", {"4", "6"}, "power moments of a pixel's optical depth besides the total")
        .choice(
            "profile", Shape::puff, shapes,
            "moments that a puff adds: those of its extinction along the ray, or, as in the paper, those of a point")
        .choice("samples", "1", {"1", "3"}, "points in a puff at which the transmittance in front of it is evaluated")
        .choice("warp", Warp::log, warps,
                "mapping of distances before their moments are taken: by the logarithm, as in the paper, or none")
        .real("overestimation", 0.5, 0, 1, "",
              "position of T between the bounds given by the moments: 0 is the brighter one, 1 the darker one")
        .real("bias_factor", 1, 0, 10'000, "",
              "factor on the paper's bias of the moments, 5e-7 for four and 5e-6 for six")
        .real("reach", 3.5, 2, 6, "deviations",
              "half-side of a puff's quad in standard deviations; exp(-reach^2/2) of its depth is cut off");
    info.parameters.preset("profile", "point", {{"overestimation", "0.25"}});
    info.create = [](const ParameterValues& values) {
        Settings settings;
        settings.moments = values.choice("moments") == "4" ? 4 : 6;
        settings.shape = values.choice("profile", shapes);
        settings.samples = values.choice("samples") == "3" ? 3 : 1;
        settings.warp = values.choice("warp", warps);
        settings.overestimation = values.real("overestimation");
        settings.biasFactor = values.real("bias_factor");
        settings.reachDeviations = values.real("reach");
        return std::make_unique<MomentOit>(settings);
    };
    return info;
}

}  // namespace dustbench::moment_oit
