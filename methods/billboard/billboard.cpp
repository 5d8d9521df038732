#include "methods/billboard/billboard.h"

#include "methods/contract/errors.h"
#include "methods/contract/volume.h"
#include "methods/kit/files/data_folder.h"
#include "methods/kit/parallel/for_each_block.h"

namespace dustbench::billboard {
namespace {

std::optional<draw::PuffTextures> loadPictures(Puff puff, gpu::Device& device) {
    const auto load = [&](const char* id, draw::PuffTextures::Frames frames) {
        return draw::PuffTextures(device, files::findData("puff picture", "textures", id, ".png"), frames);
    };
    switch (puff) {
        case Puff::gaussian:
            return std::nullopt;
        case Puff::texture:
            return load("puff", draw::PuffTextures::Frames::separate);
        case Puff::textures:
            return load("puffs", draw::PuffTextures::Frames::separate);
        case Puff::animated:
            return load("puff_animated", draw::PuffTextures::Frames::crossFaded);
    }
    return std::nullopt;
}

/// The picture index of particle `i`: by serial, or by age for an animation.
float frameOf(const Puffs& dust, std::size_t i, Puff puff, int frames) {
    if (puff == Puff::animated)
        return std::clamp(dust.age[i] / dust.lifetime[i], 0.0f, 1.0f) * static_cast<float>(frames - 1);
    return static_cast<float>(dust.serial[i] % static_cast<std::uint64_t>(frames));
}

}  // namespace

Billboard::Billboard(const Settings& settings) : settings_(settings), sort_(ledger_) {
    if (settings.opacity == draw::OpacityFrom::age)
        byAge_.emplace(ledger_.account("opacities by age"), settings.youngOpacity);
    if (settings.raster == Raster::tiles && settings.puff != Puff::gaussian)
        throw InputError("parameter raster: got tiles with puff=" + std::string(puffs.wordOf(settings.puff)) +
                         ", allowed: tiles with puff=gaussian, or hardware");
    if (settings.raster == Raster::tiles && settings.noise.isOn())
        throw InputError("parameter raster: got tiles with noise, allowed: tiles without noise, or hardware");
}

void Billboard::prepare(const scene::Scene&, const RunSetup&, gpu::Device& device) {
    device_ = &device;
    pictures_ = loadPictures(settings_.puff, device);
    quads_.emplace(device, settings_.style, pictures_ ? &*pictures_ : nullptr);
    if (settings_.raster == Raster::tiles) tiles_.emplace(device, settings_.style);
}

void Billboard::updateOnGpu(const Frame& frame) {
    const GpuPuffs& dust = *frame.gpuDust;
    const gpu::Buffer* order = nullptr;
    if (settings_.sort != draw::SortKind::none) {
        const auto timing = frame.clock.measure(Stage::sort);
        if (!gpuOrder_) gpuOrder_.emplace(*device_);
        order = &gpuOrder_->farToNear(dust, glm::vec3(frame.view.camera.eye));
    }
    const auto timing = frame.clock.measure(Stage::upload);
    quads_->gather(dust, order);
}

void Billboard::update(const Frame& frame) {
    if (frame.gpuDust) return updateOnGpu(frame);
    const Puffs& dust = frame.dust;
    const std::span<const float> opacity = byAge_ ? byAge_->of(dust) : dust.opacity;
    std::span<const std::uint32_t> order;
    {
        const auto timing = frame.clock.measure(Stage::sort);
        order = sort_.farToNear(settings_.sort, {dust.x, dust.y, dust.z}, glm::vec3(frame.view.camera.eye));
    }
    const auto timing = frame.clock.measure(Stage::upload);
    upload(dust, opacity, order);
}

void Billboard::upload(const Puffs& dust, std::span<const float> opacity, std::span<const std::uint32_t> order) {
    const draw::InstanceLayout layout = quads_->layout(!dust.uniformColour);
    const std::span<float> memory = quads_->map(order.size(), layout);
    const int frames = pictures_ ? pictures_->frames() : 0;
    const auto fill = [&](std::size_t first, std::size_t count) {
        float* value = memory.data() + first * layout.floats;
        for (std::size_t place = first; place < first + count; ++place) {
            const std::uint32_t i = order[place];
            *value++ = dust.x[i];
            *value++ = dust.y[i];
            *value++ = dust.z[i];
            *value++ = dust.radius[i];
            *value++ = opacity[i];
            if (quads_->framed()) *value++ = frameOf(dust, i, settings_.puff, frames);
            if (quads_->noisy()) {
                const auto [noise, metres] =
                    draw::noiseOf(dust.serial[i], dust.radius[i], glm::vec3(0), settings_.noise);
                for (const float each : {noise.x, noise.y, noise.z, metres}) *value++ = each;
            }
            if (layout.coloured) {
                *value++ = dust.red[i];
                *value++ = dust.green[i];
                *value++ = dust.blue[i];
            }
        }
    };
    // The reads jump through memory in depth order; a second thread hides this latency.
    parallel::forEachBlock(order.size(), 16'384, fill);
    quads_->unmap();
}

void Billboard::draw(const Frame& frame, gpu::Layer& layer) {
    if (tiles_)
        tiles_->draw(*quads_, frame.view, frame.dust.colourOfAll, layer, frame.clock);
    else
        quads_->draw(frame.view, frame.dust.colourOfAll, layer);
}

void Billboard::volume(const Frame& frame, VolumeVisitor& visitor) const {
    Puffs shown = frame.dust;
    if (byAge_) shown.opacity = byAge_->column();
    visitor.puffs(shown);
}

void Billboard::report(const Frame&, Facts&) const {
    if (tiles_) tiles_->requireWholeLoops("billboard");
}

MemoryReport Billboard::memory() const {
    MemoryReport report;
    for (const auto& [structure, bytes] : ledger_.entries()) report.push_back({structure, bytes, 0});
    if (quads_) report.push_back({"billboards", 0, quads_->gpuBytes()});
    if (tiles_) report.push_back({"lists of tiles", 0, tiles_->bytes()});
    if (gpuOrder_) report.push_back({"depth order", 0, gpuOrder_->bytes()});
    if (pictures_) report.push_back({"puff pictures", 0, pictures_->texture().bytes()});
    return report;
}

std::int64_t Billboard::primitives() const {
    return quads_ ? quads_->primitives() : 0;
}

MethodInfo describe() {
    MethodInfo info;
    info.title = "Billboard dust";
    info.summary =
        "One camera-facing quad for each particle, sorted far to near and blended in one instanced draw call.";
    info.source = "Carr2006";
    info.takesLights = true;
    info.parameters
        .choice("sort", draw::SortKind::radix, draw::sortKinds,
                "order in which puffs are blended: far to near by the paper's quicksort or a radix sort, or unsorted")
        .choice(
            "puff", Puff::gaussian, puffs,
            "image on a quad: the optical model's Gaussian, one picture, one of several, or an animation over its life")
        .boolean("soft", false, "fade puffs out where they meet the scene instead of cutting them off")
        .choice("facing", draw::Facing::viewpoint, draw::facings,
                "turn each quad towards the camera's position, or keep all quads parallel to the image plane")
        .choice("alpha", Alpha::optical, alphas,
                "meaning of a puff's picture: optical depth, or, as in the paper, a factor on the puff's opacity "
                "(puff=gaussian is then a circle that fades smoothly)")
        .choice("raster", Raster::hardware, rasters,
                "blend with the GPU's rasteriser, or tile by tile in a compute shader, for GPUs that hardly rasterise; "
                "the same picture; tiles need puff=gaussian and noise=0");
    draw::declareOpacity(info.parameters);
    draw::declareNoise(info.parameters);
    info.parameters.choice("mode", "fixed", {"fixed", "paper"}, "draw by the optical model, or as in the paper")
        .preset("mode", "paper", {{"sort", "quicksort"}, {"puff", "texture"}, {"alpha", "plain"}, {"opacity", "age"}});
    // Pictures, noise, the opacity by age and the paper's quicksort run on the CPU.
    info.takesGpuDust = [](const ParameterValues& values) {
        return values.choice("sort", draw::sortKinds) != draw::SortKind::quicksort &&
               values.choice("puff", puffs) == Puff::gaussian && !draw::noiseSettings(values).isOn() &&
               values.choice("opacity", draw::opacityOrigins) == draw::OpacityFrom::dust;
    };
    info.create = [](const ParameterValues& values) -> std::unique_ptr<Method> {
        Settings settings;
        settings.sort = values.choice("sort", draw::sortKinds);
        settings.puff = values.choice("puff", puffs);
        settings.style.soft = values.boolean("soft");
        settings.style.plainAlpha = values.choice("alpha", alphas) == Alpha::plain;
        settings.opacity = values.choice("opacity", draw::opacityOrigins);
        settings.youngOpacity = values.real("young_opacity");
        settings.raster = values.choice("raster", rasters);
        settings.noise = draw::noiseSettings(values);
        settings.style.noise = settings.noise.amplitude;
        settings.style.facing = values.choice("facing", draw::facings);
        return std::make_unique<Billboard>(settings);
    };
    return info;
}

}  // namespace dustbench::billboard
