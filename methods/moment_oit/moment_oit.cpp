#include "methods/moment_oit/moment_oit.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <limits>
#include <map>
#include <string>
#include <utility>

#include "draw_shaders.h"
#include "methods/contract/errors.h"
#include "methods/kit/draw/cost_facts.h"
#include "methods/kit/maths/transmittance.h"
#include "moment_oit_shaders.h"

namespace dustbench::moment_oit {
namespace {

/// Numbers as the arguments of a shader's array.
std::string listOf(std::span<const double> numbers) {
    std::string list;
    for (const double number : numbers) {
        std::array<char, 32> text{};
        (void)std::snprintf(text.data(), text.size(), "%.9e", number);
        list.append(list.empty() ? "" : ", ").append(text.data());
    }
    return list;
}

std::map<std::string, std::string> definitionsOf(const Settings& settings) {
    const Kind& kind = settings.kind;
    const bool surface = settings.puff == Puff::surface;
    std::map<std::string, std::string> names{{"MOMENTS", std::to_string(kind.count)},
                                             {"SAMPLES", std::to_string(surface ? 1 : settings.samples)},
                                             {"TOWARDS", listOf(towards(kind))}};
    if (settings.warp == Warp::log) names["WARP_LOG"] = "";
    if (surface) names["SURFACE"] = "";
    if (surface || settings.shape == Shape::point) names["POINTS"] = "";
    if (kind.basis == Basis::trigonometric) {
        names["TRIGONOMETRIC"] = "";
        names["WRAPPING_ZONE"] = listOf({&wrappingZone, 1});
    }
    if (kind.precision == Precision::quantised) {
        names["QUANTISED"] = "";
        if (kind.basis == Basis::power) {
            const Transform odd = oddTransform(kind.count), even = evenTransform(kind.count);
            names["QUANTISE_ODD"] = listOf(odd.matrix), names["QUANTISE_EVEN"] = listOf(even.matrix);
            names["DEQUANTISE_ODD"] = listOf(inverseOf(odd.matrix));
            names["DEQUANTISE_EVEN"] = listOf(inverseOf(even.matrix));
            names["OFFSET_ODD"] = listOf(odd.offset), names["OFFSET_EVEN"] = listOf(even.offset);
        }
    }
    return names;
}

std::vector<gpu::Format> momentFormats(const Kind& kind) {
    using enum gpu::Format;
    if (kind.precision == Precision::quantised) return {r32F};  // b₀; the others are in a buffer
    if (kind.count == 4) return {rgba32F, r32F};
    if (kind.count == 6) return {rgba32F, rgba32F};
    return {rgba32F, rgba32F, r32F};
}

/// Bytes per pixel of the quantised moments.
std::size_t storedBytes(const Kind& kind) {
    return 2 * static_cast<std::size_t>(kind.count);
}

/// Offset and factor of the shaders' `warped`: it subtracts x, then multiplies by y.
glm::vec2 warpUniform(const WarpedDepth& depth) {
    const double from = depth.warp == Warp::log ? std::log(depth.nearestMetres) : depth.nearestMetres;
    const double to = depth.warp == Warp::log ? std::log(depth.farthestMetres) : depth.farthestMetres;
    return {from, 2 / (to - from)};
}

}  // namespace

WarpedDepth depthRange(const Puffs& dust, const scene::View& view, Warp warp, Puff puff) {
    constexpr double deviations = 3;
    const glm::dvec3 eye = view.camera.eye, ahead = glm::normalize(view.camera.target - eye);
    double nearest = std::numeric_limits<double>::infinity(), farthest = 0;
    for (std::size_t i = 0; i < dust.size(); ++i) {
        const glm::dvec3 centre = glm::dvec3(dust.position(i)) - eye;
        const double along = glm::dot(centre, ahead);
        if (puff == Puff::surface) {
            if (along < view.camera.nearMetres) continue;
            nearest = std::min(nearest, along);
            farthest = std::max(farthest, along);
            continue;
        }
        const double reach = deviations * maths::puffDeviationMetres(static_cast<double>(dust.radius[i]));
        if (along < -reach) continue;
        nearest = std::min(nearest, glm::length(centre) - reach);
        farthest = std::max(farthest, glm::length(centre) + reach);
    }
    nearest = std::max(nearest <= farthest ? nearest : 0, view.camera.nearMetres);
    return {warp, nearest, std::max(farthest, 1.01 * nearest)};
}

void MomentOit::prepare(const scene::Scene&, const RunSetup&, gpu::Device& device) {
    device_ = &device;
    auto definitions = definitionsOf(settings_);
    quads_.emplace(device, settings_.reachDeviations);
    moments_.emplace(device, "moments", momentFormats(settings_.kind));
    colours_.emplace(device, "weighted colours", std::vector<gpu::Format>{gpu::Format::rgba32F});
    average_.emplace(device);
    using namespace moment_oit_shaders;
    warp_.emplace(device, depth_extent_glsl, definitions);
    const Kind& kind = settings_.kind;
    std::vector<gpu::ShaderFile> files{moments_glsl, bias_glsl};
    files.push_back(kind.basis == Basis::power && kind.count < 8 ? transmittance_glsl : canonical_measure_glsl);
    if (isQuantised()) files.push_back(quantise_glsl);
    files.push_back(moment_colour_frag);
    colourPass_ = draw::puffPass("colours by moments", std::move(files), definitions);
    if (!isQuantised())
        momentPass_ = draw::puffPass("moments", {moments_glsl, moment_sum_frag}, std::move(definitions));
}

void MomentOit::update(const Frame& frame) {
    const auto timing = frame.clock.measure(Stage::upload);
    frame.gpuDust ? quads_->gather(*frame.gpuDust) : quads_->upload(frame.dust);
}

void MomentOit::draw(const Frame& frame, gpu::Layer& layer) {
    if (quads_->count() == 0) return;
    if (frame.gpuDust)
        warp_->useRangeOf(*frame.gpuDust, frame.view);
    else
        warp_->use(warpUniform(depthRange(frame.dust, frame.view, settings_.warp, settings_.puff)));
    isQuantised() ? addQuantisedMoments(frame, layer) : addMoments(frame, layer);

    gpu::Program& second = quads_->begin(*colourPass_, frame.view);
    second.set("momentBias", static_cast<float>(settings_.biasFactor * biasOf(settings_.kind)));
    second.set("overestimation", static_cast<float>(settings_.overestimation));
    if (!quads_->isColoured()) second.set("puffColour", frame.dust.colourOfAll);
    if (isQuantised()) {
        second.set("pictureWidth", layer.width());
        quantisedMoments_.bindStorage(1);
    }
    colours_->begin(layer.width(), layer.height());
    for (std::size_t i = 0; i < momentFormats(settings_.kind).size(); ++i)
        moments_->texture(i).bind(static_cast<std::uint32_t>(i + 1));
    quads_->add(second, layer.sceneDepth());
    average_->draw(colours_->texture(0), total(), layer);
}

void MomentOit::addMoments(const Frame& frame, const gpu::Layer& layer) {
    gpu::Program& first = quads_->begin(*momentPass_, frame.view);
    moments_->begin(layer.width(), layer.height());
    quads_->add(first, layer.sceneDepth());
}

void MomentOit::addQuantisedMoments(const Frame& frame, const gpu::Layer& layer) {
    if (!quantisedPass_) {
        auto definitions = definitionsOf(settings_);
        definitions["COLOURLESS"] = "";
        using namespace moment_oit_shaders;
        quantisedPass_.emplace(*device_, "moment_oit",
                               std::vector<gpu::ShaderFile>{moments_glsl, quantise_glsl, quantised_sum_comp},
                               std::move(definitions), settings_.reachDeviations);
    }
    gpu::Program& program = quantisedPass_->begin(*quads_, frame);

    const std::size_t bytes = storedBytes(settings_.kind) * static_cast<std::size_t>(layer.width()) *
                              static_cast<std::size_t>(layer.height());
    if (bytes > device_->maximumStorageBytes())
        throw InputError("precision=quantised: got " + std::to_string(layer.width()) + "x" +
                         std::to_string(layer.height()) + " pixels, allowed: up to " +
                         std::to_string(device_->maximumStorageBytes() / storedBytes(settings_.kind)) +
                         " pixels on this device");
    if (quantisedMoments_.bytes() != bytes) quantisedMoments_ = gpu::Buffer(*device_, "quantised moments", bytes);
    moments_->begin(layer.width(), layer.height());
    quantisedMoments_.bindStorage(1);
    moments_->texture(0).bindImage(1, false, true);
    quantisedPass_->run(*quads_, program, layer);
}

void MomentOit::report(const Frame&, Facts& facts) const {
    if (quantisedPass_) quantisedPass_->requireWholeLoops();
    const std::size_t colours = gpu::bytesPerTexel(gpu::Format::rgba32F);
    std::size_t moments = isQuantised() ? storedBytes(settings_.kind) : 0;
    for (const gpu::Format format : momentFormats(settings_.kind)) moments += gpu::bytesPerTexel(format);
    facts.set("bits_per_pixel", 8.0 * static_cast<double>(moments + colours));
    // Moments are added to, unless they stay in the invocation, and read; colours are added to.
    facts.set("bytes_per_fragment", static_cast<std::int64_t>((isQuantised() ? 1 : 3) * moments + 2 * colours));
}

MemoryReport MomentOit::memory() const {
    MemoryReport report;
    if (quads_) report.push_back({"puffs", 0, quads_->gpuBytes()});
    if (moments_) report.push_back({"moments", 0, moments_->gpuBytes() + quantisedMoments_.bytes()});
    if (colours_) report.push_back({"weighted colours", 0, colours_->gpuBytes()});
    return report;
}

std::int64_t MomentOit::primitives() const {
    return quads_ ? 2 * quads_->primitives() : 0;  // two passes
}

MethodInfo describe() {
    MethodInfo info;
    info.title = "Moment-based OIT";
    info.summary =
        "Adds up puffs in any order in two passes: moments of the depth along each ray, then colours weighted by "
        "transmittance.";
    info.source = "Munstermann2018";
    info.takesLights = true;
    info.parameters
        .choice("moments", "6", {"4", "6", "8"},
                "numbers per pixel besides the total: power moments of the optical depth, or the real and imaginary "
                "parts of 2, 3 or 4 trigonometric moments")
        .choice("basis", Basis::power, bases, "moments of the warped distance, or of its angle on a circle")
        .choice("precision", Precision::single, precisions,
                "32-bit floats, or 16-bit integers with the paper's transforms")
        .choice("puff", Puff::volume, puffKinds,
                "a puff as a surface at its centre's depth, as published, or as a volume cut by eye and scene")
        .choice("profile", Shape::puff, shapes,
                "moments that a volume adds: those of its extinction along the ray, or those of a point")
        .choice("samples", "1", {"1", "3"}, "points in a volume at which the transmittance in front of it is evaluated")
        .choice("warp", Warp::log, warps,
                "mapping of distances before their moments are taken: by the logarithm, as in the paper, or none")
        .real("overestimation", 0.5, 0, 1, "",
              "position of T between the bounds given by the moments: 0 is the brighter one, 1 the darker one")
        .real("bias_factor", 1, 0, 10'000, "",
              "factor on the paper's bias of the moments, which depends on moments, basis and precision, such as 5e-6 "
              "for six power moments in floats; their product is 1 at most")
        .real("reach", 3.5, 2, 6, "deviations",
              "half-side of a puff's quad in standard deviations; exp(-reach^2/2) of its depth is cut off")
        .choice("mode", "fixed", {"fixed", "paper"}, "puffs as volumes, or as surfaces as in the paper");
    info.parameters.preset("mode", "paper", {{"puff", "surface"}});
    info.parameters.preset("puff", "surface", {{"overestimation", "0.25"}});
    info.parameters.preset("profile", "point", {{"overestimation", "0.25"}});
    info.facts = {draw::bitsPerPixel(), draw::bytesPerFragment()};
    info.takesGpuDust = [](const ParameterValues&) { return true; };
    info.create = [](const ParameterValues& values) {
        Settings settings;
        settings.kind = {.basis = values.choice("basis", bases),
                         .precision = values.choice("precision", precisions),
                         .count = std::stoi(values.choice("moments"))};
        settings.puff = values.choice("puff", puffKinds);
        settings.shape = values.choice("profile", shapes);
        settings.samples = values.choice("samples") == "3" ? 3 : 1;
        settings.warp = values.choice("warp", warps);
        settings.overestimation = values.real("overestimation");
        settings.biasFactor = values.real("bias_factor");
        settings.reachDeviations = values.real("reach");
        if (settings.biasFactor * biasOf(settings.kind) > 1)
            throw InputError("bias_factor: got " + values.canonical().find("bias_factor")->second + ", allowed: 0.." +
                             std::to_string(static_cast<int>(1 / biasOf(settings.kind))) + " with these moments");
        return std::make_unique<MomentOit>(settings);
    };
    return info;
}

}  // namespace dustbench::moment_oit
