#include "bench/run/frame_runner.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "bench/measure/memory_probe.h"

namespace dustbench::bench {
namespace {

/// Half a step of an 8-bit image: less cannot be seen, and the order of additions on a GPU may differ.
constexpr float sameColour = 0.5f / 255;

/// Divided, not multiplied by 1e-6: 3497 ns is the number 0.003497 and is written so.
double milliseconds(std::int64_t ns) {
    return static_cast<double>(ns) / 1e6;
}

std::int64_t cpuBytes(const MemoryReport& report) {
    std::size_t bytes = 0;
    for (const MemoryUse& use : report) bytes += use.cpuBytes;
    return static_cast<std::int64_t>(bytes);
}

/// The largest difference of any channel; infinite where one of the pictures holds something that is not a number.
float largestDifference(const draw::Image& a, const draw::Image& b) {
    float largest = 0;
    for (std::size_t i = 0; i < a.pixels.size(); ++i)
        for (int channel = 0; channel < 4; ++channel) {
            const float difference = std::abs(a.pixels[i][channel] - b.pixels[i][channel]);
            largest =
                std::isfinite(difference) ? std::max(largest, difference) : std::numeric_limits<float>::infinity();
        }
    return largest;
}

}  // namespace

std::int64_t stepsBeforeWarmup(const World& world) {
    return std::max<std::int64_t>(world.prerollSteps(), 1);
}

FrameRunner::FrameRunner(const RunSpec& spec, World& world, gpu::Device& device, std::unique_ptr<Method> method,
                         bool useGpuTimers)
    : spec_(spec),
      world_(world),
      device_(device),
      method_(std::move(method)),
      scene_(world.scene(), device, spec.size.width, spec.size.height),
      layer_(device, scene_.depth()),
      composite_(device, spec.size.width, spec.size.height),
      useGpuTimers_(useGpuTimers) {
    method_->prepare(world.scene(), device);
    if (spec.sync == Sync::stage) recorder_.setFence([this] { device_.finish(); });
    records_.reserve(static_cast<std::size_t>(spec.frames));
}

void FrameRunner::stepWithoutPicture(std::int64_t index) {
    world_.readInput();
    world_.simulate();
    if (!method_->wantsPreroll()) return;
    const scene::View view = world_.view(spec_.size.width, spec_.size.height);
    method_->update({index, stepSeconds, world_.state(), world_.dust(), view, StageClock()});
    device_.finish();
}

void FrameRunner::updateOnly(std::int64_t index) {
    world_.readInput();
    world_.simulate();
    lastIndex_ = index;
    const scene::View view = world_.view(spec_.size.width, spec_.size.height);
    const StageClock unheard;
    method_->update({index, stepSeconds, world_.state(), world_.dust(), view, unheard});
    device_.finish();
}

void FrameRunner::verifiedStep(std::int64_t index) {
    world_.readInput();
    world_.simulate();
    const scene::View view = world_.view(spec_.size.width, spec_.size.height);

    const StageClock unheard;
    const Frame fast{index, stepSeconds, world_.state(), world_.dust(), view, unheard};
    method_->update(fast);
    drawFrame(fast);
    const draw::Image fastLayer = draw::readBack(layer_.colour());
    const draw::Image fastResult = draw::readBack(composite_.result());

    device_.finish();
    StageRecorder fencing;
    fencing.setFence([this] { device_.finish(); });
    const StageClock fenced(&fencing);
    drawFrame({index, stepSeconds, world_.state(), world_.dust(), view, fenced});
    const float difference = std::max(largestDifference(fastLayer, draw::readBack(layer_.colour())),
                                      largestDifference(fastResult, draw::readBack(composite_.result())));
    if (!(difference <= sameColour))
        throw std::runtime_error(
            fmt::format("verification: the same frame drawn fast and drawn stage by stage differs by {:.4g}, allowed: "
                        "{:.4g} (a barrier is missing, or a draw call changes its method's state)",
                        difference, sameColour));
}

void FrameRunner::drawFrame(const Frame& frame) {
    {
        const auto timing = frame.clock.measure(Stage::scene);
        scene_.draw(frame.state, frame.view);
    }
    const auto timing = frame.clock.measure(Stage::draw);
    {
        const auto detail = frame.clock.measureDetail("layer");
        layer_.clear();
        method_->draw(frame, layer_);
    }
    const auto detail = frame.clock.measureDetail("composite");
    composite_.draw(scene_.colour(), layer_.colour());
}

void FrameRunner::waitForGpu() {
    if (spec_.sync != Sync::none) {
        device_.finish();
        return;
    }
    // The frame before this one must be done: then this one and the next are the two in flight.
    gpu::Fence thisFrame = gpu::Fence::afterQueuedWork();
    lastFrame_.wait();
    lastFrame_ = std::move(thisFrame);
}

void FrameRunner::frame(std::int64_t index) {
    recorder_.clear();
    lastIndex_ = index;
    const StageClock clock(&recorder_);
    const bool timeGpu = useGpuTimers_ && index >= 0;
    gpu::TimerQuery gpuTime = timeGpu ? gpu::TimerQuery(device_) : gpu::TimerQuery();

    // Frames that overlap follow each other without a gap, or the GPU would work in time that belongs to no frame.
    const std::int64_t start = lastEndNs_ != 0 ? lastEndNs_ : steadyNow();
    {
        const auto timing = clock.measure(Stage::input);
        world_.readInput();
    }
    {
        const auto timing = clock.measure(Stage::simulate);
        world_.simulate();
    }
    const scene::View view = world_.view(spec_.size.width, spec_.size.height);
    const Frame now{index, stepSeconds, world_.state(), world_.dust(), view, clock};
    {
        const auto timing = clock.measure(Stage::build);
        method_->update(now);
    }
    if (timeGpu) gpuTime.begin();
    drawFrame(now);
    if (timeGpu) gpuTime.end();
    {
        const auto timing = clock.measure(Stage::wait);
        waitForGpu();
    }
    const std::int64_t end = steadyNow();

    if (spec_.sync == Sync::none) lastEndNs_ = end;
    if (index < 0) return;
    keepRecord(index, end - start);
    if (timeGpu) pendingGpuTimes_.emplace_back(records_.size() - 1, std::move(gpuTime));
    collectGpuTimes();
}

void FrameRunner::keepRecord(std::int64_t index, std::int64_t elapsedNs) {
    FrameRecord record;
    record.frame = index;
    record.timeSeconds = world_.state().timeSeconds;
    record.frameMs = milliseconds(elapsedNs);
    for (std::size_t stage = 0; stage < stageNames.size(); ++stage)
        record.stageMs[stage] = milliseconds(recorder_.stageNs()[stage]);
    for (const StageRecorder::Detail& detail : recorder_.details())
        record.details.push_back({detail.stage, std::string(detail.name), milliseconds(detail.ns)});
    record.particles = static_cast<std::int64_t>(world_.dust().size());
    record.primitives = method_->primitives();
    record.clipped = method_->clipped();
    record.cpuBytes = cpuBytes(world_.memory()) + cpuBytes(method_->memory());
    record.gpuBytes = static_cast<std::int64_t>(device_.ledger().totalBytes());
    record.rssBytes = residentBytes();
    records_.push_back(std::move(record));
}

void FrameRunner::collectGpuTimes() {
    while (!pendingGpuTimes_.empty()) {
        const auto gpuMs = pendingGpuTimes_.front().second.milliseconds();
        if (!gpuMs) return;
        records_[pendingGpuTimes_.front().first].gpuMs = gpuMs;
        pendingGpuTimes_.pop_front();
    }
}

void FrameRunner::drain() {
    device_.finish();
    lastFrame_ = gpu::Fence();
    lastEndNs_ = 0;
    collectGpuTimes();
}

std::optional<double> FrameRunner::massKept() const {
    const scene::View view = world_.view(spec_.size.width, spec_.size.height);
    const StageClock unheard;
    return method_->massKept({lastIndex_, stepSeconds, world_.state(), world_.dust(), view, unheard});
}

void FrameRunner::volume(VolumeVisitor& visitor) const {
    const scene::View view = world_.view(spec_.size.width, spec_.size.height);
    const StageClock unheard;
    method_->volume({lastIndex_, stepSeconds, world_.state(), world_.dust(), view, unheard}, visitor);
}

DrawnMoment FrameRunner::drawn(bool withDetail) {
    const scene::View view = world_.view(spec_.size.width, spec_.size.height);
    const StageClock unheard;
    const Frame now{lastIndex_, stepSeconds, world_.state(), world_.dust(), view, unheard};
    drawFrame(now);
    DrawnMoment moment;
    moment.scene = draw::readBack(scene_.colour());
    moment.layer = draw::readBack(layer_.colour());
    moment.sceneDepth = draw::readBackDepth(scene_.depth());
    if (withDetail) {
        if (noScene_.width() == 0)
            noScene_ = gpu::Texture::make2D(device_, "no scene", gpu::Format::depth32F, view.width, view.height);
        gpu::Framebuffer(device_, "no scene", nullptr, &noScene_).clearDepth();
        gpu::Layer layer(device_, noScene_);
        layer.clear();
        method_->draw(now, layer);
        moment.layerWithoutScene = draw::readBack(layer.colour());
    }
    return moment;
}

draw::Image FrameRunner::picture() {
    drain();
    return draw::over(draw::readBack(layer_.colour()), draw::readBack(scene_.colour()));
}

}  // namespace dustbench::bench
