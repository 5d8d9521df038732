#include "methods/stochastic_transparency/stochastic_transparency.h"

#include <map>
#include <string>

#include "gpu_shaders.h"
#include "methods/contract/errors.h"
#include "methods/kit/draw/cost_facts.h"
#include "stochastic_transparency_shaders.h"

namespace dustbench::stochastic_transparency {
namespace {

std::map<std::string, std::string> definitionsOf(const Settings& settings) {
    return {{"SAMPLES", std::to_string(settings.samples)},
            {"STREAM", std::to_string(stream) + "u"},
            {"STRATIFIED", settings.stratified ? "1" : "0"},
            {"CORRECTED", settings.alphaCorrection ? "1" : "0"},
            {"VOLUME", settings.puff == Puff::volume ? "1" : "0"}};
}

}  // namespace

void StochasticTransparency::prepare(const scene::Scene&, const RunSetup& setup, gpu::Device& device) {
    namespace shaders = stochastic_transparency_shaders;
    device_ = &device;
    seed_ = setup.seed;
    quads_.emplace(device, settings_.reachDeviations);
    sums_.emplace(device, "seen colours", std::vector<gpu::Format>{gpu::Format::rgba32F, gpu::Format::r32F});
    average_.emplace(device);
    depths_ = draw::puffPass("sample depths",
                             {shaders::stochastic_surface_glsl, gpu_shaders::philox_glsl, shaders::random_mask_glsl,
                              shaders::sample_depths_frag},
                             definitionsOf(settings_));
    colours_ = draw::puffPass("seen colours", {shaders::stochastic_surface_glsl, shaders::seen_colours_frag},
                              definitionsOf(settings_));
}

void StochasticTransparency::update(const Frame& frame) {
    const auto timing = frame.clock.measure(Stage::upload);
    frame.gpuDust ? quads_->gather(*frame.gpuDust) : quads_->upload(frame.dust);
}

void StochasticTransparency::fitSamples(int width, int height) {
    const std::size_t bytes = 4 * static_cast<std::size_t>(settings_.samples) * static_cast<std::size_t>(width) *
                              static_cast<std::size_t>(height);
    const std::size_t maximumBytes = device_->maximumStorageBytes();
    if (bytes > maximumBytes)
        throw InputError("samples: got " + std::to_string(settings_.samples) + " for " + std::to_string(width) + "x" +
                         std::to_string(height) + " pixels, allowed: samples x pixels up to " +
                         std::to_string(maximumBytes / 4) + " on this device");
    if (samples_.bytes() != bytes) samples_ = gpu::Buffer(*device_, "samples", bytes);
    samples_.clear();
    samples_.bindStorage(1);
}

void StochasticTransparency::draw(const Frame& frame, gpu::Layer& layer) {
    if (quads_->count() == 0) return;
    fitSamples(layer.width(), layer.height());
    // Uncorrected sums are the picture itself.
    settings_.alphaCorrection ? sums_->begin(layer.width(), layer.height()) : layer.bindColourOnly();

    gpu::Program& depths = quads_->begin(*depths_, frame.view);
    depths.set("pictureWidth", layer.width());
    depths.set("key", glm::ivec3(static_cast<std::uint32_t>(seed_), static_cast<std::uint32_t>(seed_ >> 32), 0));
    quads_->store(depths, layer.sceneDepth());

    gpu::Program& colours = quads_->begin(*colours_, frame.view);
    colours.set("pictureWidth", layer.width());
    if (!quads_->isColoured()) colours.set("puffColour", frame.dust.colourOfAll);
    quads_->add(colours, layer.sceneDepth());
    if (settings_.alphaCorrection) average_->draw(sums_->texture(0), sums_->texture(1), layer);
}

void StochasticTransparency::report(const Frame&, Facts& facts) const {
    const std::int64_t sums = settings_.alphaCorrection ? 32 * 5 : 0;
    facts.set("bits_per_pixel", std::int64_t{32} * settings_.samples + sums);
    // All samples of an opaque fragment are updated, and read; its colour is added.
    const std::int64_t added = settings_.alphaCorrection ? sums : 4 * 32;
    facts.set("bytes_per_fragment", (3 * std::int64_t{32} * settings_.samples + 2 * added) / 8);
}

MemoryReport StochasticTransparency::memory() const {
    MemoryReport report;
    if (quads_) report.push_back({"puffs", 0, quads_->gpuBytes()});
    if (sums_) report.push_back({"seen colours", 0, sums_->gpuBytes()});
    report.push_back({"samples", 0, samples_.bytes()});
    return report;
}

std::int64_t StochasticTransparency::primitives() const {
    return quads_ ? 2 * quads_->primitives() : 0;
}

MethodInfo describe() {
    MethodInfo info;
    info.title = "Stochastic transparency";
    info.summary = "Each puff covers random samples of a pixel and is weighted by the share of samples that see it.";
    info.source = "EndertonEtAl2010";
    info.takesLights = true;
    info.parameters.integer("samples", 8, 1, 64, "samples", "samples per pixel; the noise falls with their square root")
        .boolean("stratified", true, "let a puff cover its alpha's share of the samples instead of each at random")
        .boolean("alpha_correction", true, "scale the colour to the exact alpha of all puffs")
        .choice("puff", Puff::surface, puffs,
                "a surface at the depth of the puff's centre, or a volume cut at the eye and the scene")
        .real("reach", 3.5, 2, 6, "deviations",
              "half-side of a puff's quad in standard deviations; exp(-reach^2/2) of its depth is cut off");
    info.facts = {draw::bitsPerPixel(), draw::bytesPerFragment()};
    info.takesGpuDust = [](const ParameterValues&) { return true; };
    info.create = [](const ParameterValues& values) {
        return std::make_unique<StochasticTransparency>(Settings{.samples = static_cast<int>(values.integer("samples")),
                                                                 .stratified = values.boolean("stratified"),
                                                                 .alphaCorrection = values.boolean("alpha_correction"),
                                                                 .puff = values.choice("puff", puffs),
                                                                 .reachDeviations = values.real("reach")});
    };
    return info;
}

}  // namespace dustbench::stochastic_transparency
