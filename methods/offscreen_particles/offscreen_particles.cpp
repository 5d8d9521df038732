#include "methods/offscreen_particles/offscreen_particles.h"

#include <map>
#include <memory>
#include <string>

#include "draw_shaders.h"
#include "methods/kit/draw/cost_facts.h"
#include "methods/kit/gpu/draw_call.h"
#include "offscreen_particles_shaders.h"

namespace dustbench::offscreen_particles {
namespace {

std::map<std::string, std::string> upsampleDefinitions(const Settings& settings) {
    std::map<std::string, std::string> names{{"DEPTH", "0"}, {"BILINEAR", "1"}, {"NEAREST", "2"}, {"UPSAMPLING", "0"}};
    if (settings.upsampling == Upsampling::bilinear) names["UPSAMPLING"] = "1";
    if (settings.upsampling == Upsampling::nearest) names["UPSAMPLING"] = "2";
    if (settings.edges == Edges::mixed) names["MIXED"] = "";
    return names;
}

}  // namespace

Target::Target(gpu::Device& device, std::string_view label, int width, int height, gpu::Format format)
    : depth_(gpu::Texture::make2D(device, label, gpu::Format::depth32F, width, height)),
      depthOnly_(device, label, nullptr, &depth_),
      layer_(device, depth_, format) {}

void Target::begin(const gpu::Program& depthProgram, const gpu::VertexArray& noVertices) {
    layer_.clear();
    depthOnly_.bind();
    gpu::draw(depthProgram, noVertices, {.depthWrite = true}, gpu::Primitives::triangles, 3);
}

void OffscreenParticles::prepare(const scene::Scene&, const RunSetup&, gpu::Device& device) {
    using namespace offscreen_particles_shaders;
    device_ = &device;
    noVertices_.emplace(device);
    quads_.emplace(device, draw::BillboardStyle{});
    shrinkDepth_ = gpu::Program(device, "shrink depth", {draw_shaders::composite_vert, shrink_depth_frag});
    if (settings_.edges == Edges::mixed)
        edgeDepth_ = gpu::Program(device, "edge depth", {taps_glsl, draw_shaders::composite_vert, edge_depth_frag});
    upsample_ = gpu::Program(device, "upsample", {taps_glsl, draw_shaders::composite_vert, upsample_frag},
                             upsampleDefinitions(settings_));
}

void OffscreenParticles::updateOnGpu(const Frame& frame) {
    const gpu::Buffer* order = nullptr;
    {
        const auto timing = frame.clock.measure(Stage::sort);
        if (!gpuOrder_) gpuOrder_.emplace(*device_);
        order = &gpuOrder_->farToNear(*frame.gpuDust, glm::vec3(frame.view.camera.eye));
    }
    const auto timing = frame.clock.measure(Stage::upload);
    quads_->gather(*frame.gpuDust, order);
}

void OffscreenParticles::update(const Frame& frame) {
    if (frame.gpuDust) return updateOnGpu(frame);
    const Puffs& dust = frame.dust;
    std::span<const std::uint32_t> order;
    {
        const auto timing = frame.clock.measure(Stage::sort);
        order = sort_.farToNear(draw::SortKind::radix, {dust.x, dust.y, dust.z}, glm::vec3(frame.view.camera.eye));
    }
    const auto timing = frame.clock.measure(Stage::upload);
    upload(dust, order);
}

void OffscreenParticles::upload(const Puffs& dust, std::span<const std::uint32_t> order) {
    const draw::InstanceLayout layout = quads_->layout(!dust.uniformColour);
    float* value = quads_->map(order.size(), layout).data();
    for (const std::uint32_t i : order) {
        for (const float number : {dust.x[i], dust.y[i], dust.z[i], dust.radius[i], dust.opacity[i]}) *value++ = number;
        if (!layout.coloured) continue;
        for (const float number : {dust.red[i], dust.green[i], dust.blue[i]}) *value++ = number;
    }
    quads_->unmap();
}

void OffscreenParticles::fit(const gpu::Layer& layer) {
    const int width = (layer.width() + settings_.scale - 1) / settings_.scale;
    const int height = (layer.height() + settings_.scale - 1) / settings_.scale;
    const gpu::Format format = layer.colour().format();
    const auto fitOne = [&](std::optional<Target>& target, std::string_view label, int columns, int rows) {
        if (target && target->depth().width() == columns && target->depth().height() == rows &&
            target->layer().colour().format() == format)
            return;
        target.emplace(*device_, label, columns, rows, format);
    };
    fitOne(small_, "small picture", width, height);
    if (settings_.edges == Edges::mixed) fitOne(edges_, "edges", layer.width(), layer.height());
}

void OffscreenParticles::draw(const Frame& frame, gpu::Layer& layer) {
    if (quads_->count() == 0) return;
    fit(layer);
    // The small picture has the same view: only its viewport differs.
    shrinkDepth_.set("smallSize", glm::vec2(small_->depth().width(), small_->depth().height()));
    layer.sceneDepth().bind(0);
    small_->begin(shrinkDepth_, *noVertices_);
    quads_->draw(frame.view, frame.dust.colourOfAll, small_->layer());
    if (edges_) {
        layer.sceneDepth().bind(0);
        small_->depth().bind(1);
        edges_->begin(edgeDepth_, *noVertices_);
        quads_->draw(frame.view, frame.dust.colourOfAll, edges_->layer());
    }
    layer.bindColourOnly();
    layer.sceneDepth().bind(0);
    small_->depth().bind(1);
    small_->layer().colour().bind(2);
    if (edges_) edges_->layer().colour().bind(3);
    gpu::draw(upsample_, *noVertices_, {.blend = gpu::Blend::premultiplied}, gpu::Primitives::triangles, 3);
}

std::size_t OffscreenParticles::targetBytes() const {
    return (small_ ? small_->gpuBytes() : 0) + (edges_ ? edges_->gpuBytes() : 0);
}

void OffscreenParticles::report(const Frame& frame, Facts& facts) const {
    facts.set("bits_per_pixel", 8 * static_cast<double>(targetBytes()) / frame.view.width / frame.view.height);
}

MemoryReport OffscreenParticles::memory() const {
    MemoryReport report;
    for (const auto& [structure, bytes] : ledger_.entries()) report.push_back({structure, bytes, 0});
    if (quads_) report.push_back({"billboards", 0, quads_->gpuBytes()});
    if (gpuOrder_) report.push_back({"depth order", 0, gpuOrder_->bytes()});
    report.push_back({"targets", 0, targetBytes()});
    return report;
}

std::int64_t OffscreenParticles::primitives() const {
    return quads_ ? quads_->primitives() : 0;
}

MethodInfo describe() {
    MethodInfo info;
    info.title = "Off-screen particles";
    info.summary = "Billboards at half or quarter resolution, enlarged over the scene; full resolution at depth edges.";
    info.source = "Cantlay2007";
    info.takesLights = true;
    info.parameters.choice("scale", 2, scales, "pixels per texel of the small picture, along each side")
        .choice("upsampling", Upsampling::depth, upsamplings,
                "how the small picture is enlarged: bilinear among the texels on a pixel's own surface, bilinear among "
                "all, or the nearest texel")
        .choice("edges", Edges::mixed, edgeKinds,
                "pixels at depth edges: drawn again at full resolution, or enlarged like all others");
    info.facts = {draw::bitsPerPixel()};
    info.takesGpuDust = [](const ParameterValues&) { return true; };
    info.create = [](const ParameterValues& values) {
        return std::make_unique<OffscreenParticles>(Settings{values.choice("scale", scales),
                                                             values.choice("upsampling", upsamplings),
                                                             values.choice("edges", edgeKinds)});
    };
    return info;
}

}  // namespace dustbench::offscreen_particles
