#include "bench/run/method_host.h"

#include <fmt/format.h>

#include <algorithm>

#include "methods/contract/errors.h"
#include "methods/kit/draw/read_back.h"
#include "methods/kit/gpu/buffer.h"

namespace dustbench::run {
namespace {

double asNumber(const FactValue& value) {
    return std::visit([](const auto number) { return static_cast<double>(number); }, value);
}

results::Value asCell(const FactValue& value) {
    return std::visit([](const auto number) { return results::Value(number); }, value);
}

}  // namespace

std::string whyNotTaken(const MethodInfo& method, const scene::Scene& scene) {
    if (scene.lights.onDust && !method.takesLights) return "does not support lit dust (light=sun)";
    return method.cannotTake ? method.cannotTake(scene) : "";
}

bool takesGpuDust(const MethodInfo& method, const ParameterValues& parameters) {
    return method.takesGpuDust && method.takesGpuDust(parameters);
}

MethodHost::MethodHost(const world::World& world, gpu::Device& device, const MethodInfo& info,
                       const ParameterValues& parameters, int width, int height)
    : world_(world),
      device_(device),
      info_(info),
      width_(width),
      height_(height),
      takesGpuDust_(takesGpuDust(info, parameters)),
      ofFrame_(info.facts, FactOver::maximumOfFrames),
      maxima_(info.facts.size()) {
    const gpu::LedgerScope booked(device_, ledger_);
    method_ = info.create(parameters);
    scene_ = std::make_unique<draw::OpaqueScene>(world.scene(), device, width, height,
                                                 info.drawsPanels ? draw::ScenePanels::hidden : draw::ScenePanels::flat,
                                                 world.isSceneDrawn() ? draw::Scenery::drawn : draw::Scenery::hidden);
    layer_ = std::make_unique<gpu::Layer>(device, scene_->depth());
    composite_ = std::make_unique<draw::Composite>(device, width, height);
    method_->prepare(world.scene(), world.setup(), device);
    // A method with a state of its own shows that instead of the shared dust, unless its state is that of the panels.
    dustThrowsShadow_ = world.scene().lights.onDust && (!method_->stateHash() || info.drawsPanels);
}

void MethodHost::resize(int width, int height) {
    if (width == width_ && height == height_) return;
    const gpu::LedgerScope booked(device_, ledger_);
    layer_.reset();
    scene_->resize(width, height);
    layer_ = std::make_unique<gpu::Layer>(device_, scene_->depth());
    composite_->resize(width, height);
    noScene_ = {};
    width_ = width;
    height_ = height;
}

Frame MethodHost::see(std::int64_t index, const StageClock& clock) {
    view_ = world_.view(width_, height_);
    const GpuPuffs* const onGpu = world_.gpuDust();
    if (!onGpu) return {index, world::stepSeconds, world_.state(), world_.dust(), view_, clock};
    if (takesGpuDust_) {
        Puffs none;
        none.uniformColour = onGpu->colour == nullptr;
        none.colourOfAll = onGpu->colourOfAll;
        return {index, world::stepSeconds, world_.state(), none, view_, clock, onGpu};
    }
    const auto timing = clock.measure(Stage::upload);
    return {index, world::stepSeconds, world_.state(), world_.dust(), view_, clock};
}

Frame MethodHost::seeParticles(std::int64_t index, const StageClock& clock) {
    view_ = world_.view(width_, height_);
    return {index,
            world::stepSeconds,
            world_.state(),
            world_.dust(),
            view_,
            clock,
            takesGpuDust_ ? world_.gpuDust() : nullptr};
}

void MethodHost::update(const Frame& frame) {
    const gpu::LedgerScope booked(device_, ledger_);
    method_->update(frame);
}

void MethodHost::draw(const Frame& frame) {
    const gpu::LedgerScope booked(device_, ledger_);
    {
        const auto timing = frame.clock.measure(Stage::scene);
        scene_->draw(frame.state, frame.view, method_->lights(), dustThrowsShadow_ ? frame.dust : method_->shadowing());
    }
    const auto timing = frame.clock.measure(Stage::draw);
    {
        const auto detail = frame.clock.measureDetail("layer");
        layer_->clear();
        method_->draw(frame, *layer_);
    }
    const auto detail = frame.clock.measureDetail("composite");
    composite_->draw(scene_->colour(), layer_->colour());
}

pictures::Image MethodHost::layer() const {
    return draw::readBack(layer_->colour());
}

pictures::Image MethodHost::result() const {
    return draw::readBack(composite_->result());
}

pictures::Image MethodHost::picture() const {
    return pictures::over(layer(), draw::readBack(scene_->colour()));
}

reference::DrawnMoment MethodHost::drawn(const Frame& frame, bool withDetail) {
    draw(frame);
    reference::DrawnMoment moment;
    moment.scene = draw::readBack(scene_->colour());
    moment.layer = layer();
    moment.sceneDepth = draw::readBackDepth(scene_->depth());
    if (!withDetail) return moment;
    const gpu::LedgerScope booked(device_, ledger_);
    if (noScene_.width() == 0)
        noScene_ = gpu::Texture::make2D(device_, "no scene", gpu::Format::depth32F, width_, height_);
    gpu::Framebuffer(device_, "no scene", nullptr, &noScene_).clearDepth();
    gpu::Layer free(device_, noScene_);
    free.clear();
    method_->draw(frame, free);
    moment.layerWithoutScene = draw::readBack(free.colour());
    return moment;
}

void MethodHost::keepFacts(const Frame& frame) {
    if (!method_->reportsAtEnd()) keepMaxima(frame);
}

void MethodHost::keepMaxima(const Frame& frame) {
    ofFrame_.clear();
    method_->report(frame, ofFrame_);
    for (std::size_t i = 0; i < maxima_.size(); ++i)
        if (const auto value = ofFrame_.value(info_.facts[i].name);
            value && (!maxima_[i] || asNumber(*value) > asNumber(*maxima_[i])))
            maxima_[i] = value;
}

results::Columns MethodHost::facts(const Frame& lastFrame) {
    if (method_->reportsAtEnd()) keepMaxima(lastFrame);
    Facts atEnd(info_.facts, FactOver::lastFrame);
    method_->report(lastFrame, atEnd);
    results::Columns columns;
    for (std::size_t i = 0; i < maxima_.size(); ++i) {
        const FactInfo& fact = info_.facts[i];
        const auto value = fact.over == FactOver::lastFrame ? atEnd.value(fact.name) : maxima_[i];
        if (value) columns.emplace_back(fact.name, asCell(*value));
    }
    return columns;
}

std::int64_t MethodHost::primitives() const {
    if (const gpu::Buffer* const count = method_->primitiveCount()) {
        std::uint32_t number = 0;
        count->read(std::span(&number, 1));
        return number;
    }
    const std::int64_t drawn = method_->primitives();
    return drawn < 0 ? -drawn * static_cast<std::int64_t>(world_.dust().size()) : drawn;
}

std::int64_t MethodHost::cpuBytes() const {
    std::size_t bytes = 0;
    for (const MemoryUse& use : method_->memory()) bytes += use.cpuBytes;
    return static_cast<std::int64_t>(bytes);
}

void requireDustPlace(const results::RunSpec& spec, const world::World& world) {
    if (spec.dustOn != results::DustOn::gpu) return;
    if (const std::string why = world.whyDustStaysOnCpu(); !why.empty())
        throw InputError(fmt::format("dust_on: got gpu, but {} has no shader, allowed: cpu|auto", why));
}

measure::DustPlace placeDust(const results::RunSpec& spec, world::World& world, gpu::Device& device) {
    requireDustPlace(spec, world);
    const measure::DustPlace requested{std::string(results::dustPlaces.wordOf(spec.dustOn)), "requested"};
    if (spec.dustOn == results::DustOn::cpu) return requested;
    if (spec.dustOn == results::DustOn::automatic) {
        if (device.isSoftware()) return {"cpu", "software device"};
        if (const std::string why = world.whyDustStaysOnCpu(); !why.empty()) return {"cpu", why + " has no shader"};
    }
    world.moveDustTo(device);
    return spec.dustOn == results::DustOn::gpu ? requested : measure::DustPlace{"gpu", "hardware device"};
}

std::string readBackWarning(const world::World& world, const MethodInfo& info, const ParameterValues& parameters) {
    if (!world.gpuDust() || takesGpuDust(info, parameters)) return {};
    return fmt::format(
        "dust_on=gpu: the method {} takes no GPU buffers with these parameters, so each frame reads the dust back, "
        "which the stage 'upload' contains",
        info.id);
}

}  // namespace dustbench::run
