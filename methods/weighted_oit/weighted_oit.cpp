#include "methods/weighted_oit/weighted_oit.h"

#include <map>
#include <string>

#include "draw_shaders.h"
#include "methods/contract/errors.h"
#include "methods/kit/draw/cost_facts.h"
#include "methods/kit/gpu/draw_call.h"
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

gpu::Format formatOf(Accumulation accumulation) {
    return accumulation == Accumulation::rgba16f ? gpu::Format::rgba16F : gpu::Format::rgba32F;
}

gpu::Format formatOf(Revealage revealage) {
    switch (revealage) {
        case Revealage::r32f:
            return gpu::Format::r32F;
        case Revealage::r16f:
            return gpu::Format::r16F;
        case Revealage::r8:
            return gpu::Format::r8;
    }
    return gpu::Format::r32F;
}

bool isProduct(Revealage revealage) {
    return revealage != Revealage::r32f;
}

std::map<std::string, std::string> definitionsOf(const Settings& settings) {
    return {{"WEIGHT", equationOf(settings.weight)},
            {"SURFACE", settings.puff == Puff::surface ? "1" : "0"},
            {"PRODUCT", isProduct(settings.revealage) ? "1" : "0"},
            {"HALF", settings.accumulation == Accumulation::rgba16f ? "1" : "0"}};
}

}  // namespace

WeightedOit::WeightedOit(const Settings& settings) : settings_(settings) {
    if (settings.raster == Raster::tiles &&
        (settings.accumulation != Accumulation::rgba32f || settings.revealage != Revealage::r32f))
        throw InputError("parameter raster: got tiles with accumulation=" +
                         std::string(accumulations.wordOf(settings.accumulation)) +
                         " revealage=" + std::string(revealages.wordOf(settings.revealage)) +
                         ", allowed: tiles with accumulation=rgba32f revealage=r32f, or hardware");
}

void WeightedOit::prepare(const scene::Scene&, const RunSetup&, gpu::Device& device) {
    namespace shaders = weighted_oit_shaders;
    const auto definitions = definitionsOf(settings_);
    const float nothingYet = isProduct(settings_.revealage) ? 1 : 0;
    quads_.emplace(device, settings_.reachDeviations);
    if (settings_.raster == Raster::tiles) {
        tiles_.emplace(device, "weighted sums",
                       std::vector<gpu::ShaderFile>{shaders::weighted_puff_glsl, shaders::weighted_tiles_comp},
                       definitions, settings_.reachDeviations);
        return;
    }
    sums_.emplace(device, "weighted sums",
                  std::vector<gpu::Format>{formatOf(settings_.accumulation), formatOf(settings_.revealage)},
                  std::vector<float>{0, nothingYet});
    pass_ = draw::puffPass("weighted sums", {shaders::weighted_puff_glsl, shaders::weighted_sum_frag}, definitions);
    mean_.emplace(
        device, "weighted mean",
        std::initializer_list<gpu::ShaderFile>{draw_shaders::composite_vert, draw_shaders::error_function_glsl,
                                               draw_shaders::puff_ray_glsl, shaders::weighted_mean_frag},
        definitions);
    noVertices_ = gpu::VertexArray(device);
}

void WeightedOit::update(const Frame& frame) {
    const auto timing = frame.clock.measure(Stage::upload);
    frame.gpuDust ? quads_->gather(*frame.gpuDust) : quads_->upload(frame.dust);
}

void WeightedOit::draw(const Frame& frame, gpu::Layer& layer) {
    if (quads_->count() == 0) return;
    if (tiles_) {
        gpu::Program& program = tiles_->begin(*quads_, frame.view, layer, frame.clock);
        program.set("nearMetres", static_cast<float>(frame.view.camera.nearMetres));
        program.set("puffColour", frame.dust.colourOfAll);
        return tiles_->run(layer, frame.clock);
    }
    gpu::Program& program = quads_->begin(*pass_, frame.view);
    if (!quads_->isColoured()) program.set("puffColour", frame.dust.colourOfAll);
    sums_->begin(layer.width(), layer.height());
    if (isProduct(settings_.revealage))
        quads_->addAndReveal(program, layer.sceneDepth());
    else
        quads_->add(program, layer.sceneDepth());

    layer.bindColourOnly();
    sums_->texture(0).bind(0);
    sums_->texture(1).bind(1);
    gpu::draw(*mean_, noVertices_, {}, gpu::Primitives::triangles, 3);
}

void WeightedOit::report(const Frame&, Facts& facts) const {
    if (tiles_) tiles_->requireWholeLoops("weighted_oit");
    const std::size_t bytes =
        gpu::bytesPerTexel(formatOf(settings_.accumulation)) + gpu::bytesPerTexel(formatOf(settings_.revealage));
    facts.set("bits_per_pixel", static_cast<std::int64_t>(8 * bytes));
    const bool inInvocations = settings_.raster == Raster::tiles;
    facts.set("bytes_per_fragment", static_cast<std::int64_t>(inInvocations ? 0 : 2 * bytes));
}

MemoryReport WeightedOit::memory() const {
    MemoryReport report;
    if (quads_) report.push_back({"puffs", 0, quads_->gpuBytes()});
    if (tiles_) report.push_back({"lists of tiles", 0, tiles_->bytes()});
    if (sums_) report.push_back({"weighted sums", 0, sums_->gpuBytes()});
    return report;
}

std::int64_t WeightedOit::primitives() const {
    return quads_ ? quads_->primitives() : 0;
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
        .choice("accumulation", Accumulation::rgba32f, accumulations,
                "storage of the weighted sums; half precision overflows above 65504")
        .choice("revealage", Revealage::r32f, revealages,
                "storage of the cloud's transmittance: the sum of optical depths (r32f), or the product of 1 - alpha "
                "as published, rounded after each puff (r16f, r8)")
        .choice("puff", Puff::volume, puffs,
                "a volume cut at the eye and the scene, or a surface at the depth of the puff's centre")
        .real("reach", 3.5, 2, 6, "deviations",
              "half-side of a puff's quad in standard deviations; exp(-reach^2/2) of its depth is cut off")
        .choice(
            "raster", Raster::hardware, rasters,
            "add up with the GPU's rasteriser, or tile by tile in a compute shader, for GPUs that hardly rasterise; "
            "the same picture; tiles need accumulation=rgba32f and revealage=r32f")
        .choice("mode", "fixed", {"fixed", "paper"}, "paper: blended as published")
        .preset("mode", "paper", {{"accumulation", "rgba16f"}, {"revealage", "r8"}, {"puff", "surface"}});
    info.facts = {draw::bitsPerPixel(), draw::bytesPerFragment()};
    info.takesGpuDust = [](const ParameterValues&) { return true; };
    info.create = [](const ParameterValues& values) {
        return std::make_unique<WeightedOit>(Settings{.weight = values.choice("weight", weights),
                                                      .accumulation = values.choice("accumulation", accumulations),
                                                      .revealage = values.choice("revealage", revealages),
                                                      .puff = values.choice("puff", puffs),
                                                      .reachDeviations = values.real("reach"),
                                                      .raster = values.choice("raster", rasters)});
    };
    return info;
}

}  // namespace dustbench::weighted_oit
