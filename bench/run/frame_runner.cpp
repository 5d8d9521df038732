#include "bench/run/frame_runner.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "bench/measure/memory_probe.h"
#include "methods/contract/errors.h"
#include "methods/contract/registry.h"
#include "methods/kit/draw/read_back.h"

namespace dustbench::run {
namespace {

/// Half a step of an 8-bit image. Smaller differences are invisible; the order of additions on a GPU may vary.
constexpr float sameColour = 0.5f / 255;

/// Divided, not multiplied by 1e-6: 3497 ns becomes exactly 0.003497 and prints so.
double milliseconds(std::int64_t ns) {
    return static_cast<double>(ns) / 1e6;
}

std::int64_t bytesOf(const MemoryReport& report, std::size_t MemoryUse::*where) {
    std::size_t bytes = 0;
    for (const MemoryUse& use : report) bytes += use.*where;
    return static_cast<std::int64_t>(bytes);
}

/// The maximum difference of any channel; infinite if a picture has a non-finite value.
float maximumDifference(const pictures::Image& a, const pictures::Image& b) {
    float maximum = 0;
    for (std::size_t i = 0; i < a.pixels.size(); ++i)
        for (int channel = 0; channel < 4; ++channel) {
            const float difference = std::abs(a.pixels[i][channel] - b.pixels[i][channel]);
            maximum =
                std::isfinite(difference) ? std::max(maximum, difference) : std::numeric_limits<float>::infinity();
        }
    return maximum;
}

constexpr std::array<std::string_view, 4> channels{"red", "green", "blue", "alpha"};

/// The first channel that is not finite, or the number of channels.
std::size_t brokenChannel(const glm::vec4& pixel) {
    std::size_t channel = 0;
    while (channel < channels.size() && std::isfinite(pixel[static_cast<int>(channel)])) ++channel;
    return channel;
}

}  // namespace

std::int64_t stepsBeforeWarmup(const world::World& world) {
    return std::max<std::int64_t>(world.prerollSteps(), 1);
}

FrameRunner::FrameRunner(const results::RunSpec& spec, world::World& world, gpu::Device& device,
                         const ParameterValues& parameters, bool useGpuTimers)
    : spec_(spec),
      world_(world),
      device_(device),
      host_(world, device, findMethod(spec.method), parameters, spec.size.width, spec.size.height),
      useGpuTimers_(useGpuTimers) {
    if (spec.sync == results::Sync::stage) recorder_.setFence([this] { device_.finish(); });
    records_.reserve(static_cast<std::size_t>(spec.frames));
}

void FrameRunner::stepWorld() {
    world_.readInput();
    world_.simulate();
}

void FrameRunner::stepWithoutPicture(std::int64_t index) {
    if (host_.method().wantsPreroll())
        updateOnly(index);
    else
        stepWorld();
}

void FrameRunner::updateOnly(std::int64_t index) {
    stepWorld();
    lastIndex_ = index;
    const StageClock untimed;
    host_.update(host_.see(index, untimed));
    device_.finish();
}

void FrameRunner::requireFinitePicture() const {
    requireFinite(draw::readBack(host_.sceneColour()), lastIndex_, Stage::scene, "the scene");
    requireFinite(host_.layer(), lastIndex_, Stage::draw, "the method's layer");
}

void FrameRunner::verifiedStep(std::int64_t index) {
    stepWorld();
    lastIndex_ = index;
    const StageClock untimed;
    const Frame fast = host_.see(index, untimed);
    host_.update(fast);
    host_.draw(fast);
    requireFinitePicture();
    const pictures::Image fastLayer = host_.layer(), fastResult = host_.result();

    device_.finish();
    measure::StageRecorder fencing;
    fencing.setFence([this] { device_.finish(); });
    const StageClock fenced(&fencing);
    host_.draw(host_.see(index, fenced));
    const float difference =
        std::max(maximumDifference(fastLayer, host_.layer()), maximumDifference(fastResult, host_.result()));
    if (!(difference <= sameColour))
        throw std::runtime_error(
            fmt::format("verification: the same frame drawn fast and drawn stage by stage differs by {:.4g}, allowed: "
                        "{:.4g} (a barrier is missing, or a draw call changes its method's state)",
                        difference, sameColour));
}

void FrameRunner::waitForGpu() {
    if (spec_.sync != results::Sync::none) {
        device_.finish();
        return;
    }
    // Waits for the previous frame, so that this one and the next are the two in flight.
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

    // Overlapping frames are timed without a gap; otherwise GPU work would fall into time that belongs to no frame.
    const std::int64_t start = lastEndNs_ != 0 ? lastEndNs_ : measure::steadyNow();
    {
        const auto timing = clock.measure(Stage::input);
        world_.readInput();
    }
    {
        const auto timing = clock.measure(Stage::simulate);
        world_.simulate();
        if (!world_.gpuDust()) (void)world_.dust();  // lights it, if the sun does
    }
    const Frame now = host_.see(index, clock);
    {
        const auto timing = clock.measure(Stage::build);
        host_.update(now);
    }
    if (timeGpu) gpuTime.begin();
    host_.draw(now);
    if (timeGpu) gpuTime.end();
    {
        const auto timing = clock.measure(Stage::wait);
        waitForGpu();
    }
    const std::int64_t end = measure::steadyNow();

    if (spec_.sync == results::Sync::none) lastEndNs_ = end;
    if (index < 0) return;
    keepRecord(index, end - start);
    host_.keepFacts(now);
    if (timeGpu) pendingGpuTimes_.emplace_back(records_.size() - 1, std::move(gpuTime));
    collectGpuTimes();
}

void FrameRunner::keepRecord(std::int64_t index, std::int64_t elapsedNs) {
    measure::FrameRecord record;
    record.frame = index;
    record.timeSeconds = world_.state().timeSeconds;
    record.frameMs = milliseconds(elapsedNs);
    for (std::size_t stage = 0; stage < stageNames.size(); ++stage)
        record.stageMs[stage] = milliseconds(recorder_.stageNs()[stage]);
    for (const measure::StageRecorder::Detail& detail : recorder_.details())
        record.details.push_back({detail.stage, std::string(detail.name), milliseconds(detail.ns)});
    if (const gpu::Buffer* const count = host_.method().primitiveCount())
        keepCount(*count, false);
    else
        record.primitives = host_.method().primitives();
    if (const GpuPuffs* const dust = world_.gpuDust())
        keepCount(*dust->tally, true);
    else
        record.particles = static_cast<std::int64_t>(world_.dust().size());
    const MemoryReport ofWorld = world_.memory();
    record.cpuBytes = bytesOf(ofWorld, &MemoryUse::cpuBytes) + host_.cpuBytes();
    record.gpuBytes = bytesOf(ofWorld, &MemoryUse::gpuBytes) + host_.gpuBytes();
    record.rssBytes = measure::residentBytes();
    records_.push_back(std::move(record));
    if (spec_.sync != results::Sync::none) collectCounts();
}

/// Copies a number of the frame that is recorded next, to be read later: with frames in flight, reading now would wait
/// for them.
void FrameRunner::keepCount(const gpu::Buffer& number, bool isOfParticles) {
    constexpr std::size_t bytes = sizeof(std::uint32_t);
    pendingCounts_.push_back({records_.size(), isOfParticles, gpu::Buffer(device_, "a number of the frame", bytes)});
    pendingCounts_.back().number.copyFrom(number, bytes);
}

void FrameRunner::collectCounts() {
    for (const PendingCount& pending : pendingCounts_) {
        std::uint32_t number = 0;
        pending.number.read(std::span(&number, 1));
        measure::FrameRecord& record = records_[pending.record];
        if (pending.isOfParticles) record.particles = number;
        if (!pending.isOfParticles)
            record.primitives = number;
        else if (record.primitives < 0)
            record.primitives *= -std::int64_t{number};
    }
    pendingCounts_.clear();
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
    collectCounts();
    collectGpuTimes();
}

void FrameRunner::volume(VolumeVisitor& visitor) {
    const StageClock untimed;
    host_.method().volume(host_.seeParticles(lastIndex_, untimed), visitor);
}

results::Columns FrameRunner::facts() {
    const StageClock untimed;
    return host_.facts(host_.seeParticles(lastIndex_, untimed));
}

reference::DrawnMoment FrameRunner::drawn(bool withDetail) {
    const StageClock untimed;
    return host_.drawn(host_.see(lastIndex_, untimed), withDetail);
}

pictures::Image FrameRunner::picture() {
    drain();
    return host_.picture();
}

bool replay(const Replay& replay) {
    for (std::int64_t step = 0; step < replay.prerollSteps; ++step) {
        replay.progress("preroll", step, replay.prerollSteps);
        const std::int64_t index = step - replay.prerollSteps - replay.spec.warmup;
        step + 1 < replay.prerollSteps ? replay.runner.stepWithoutPicture(index) : replay.runner.updateOnly(index);
        if (!replay.stepped()) return false;
    }
    for (std::int64_t index = -replay.spec.warmup; index <= replay.lastFrame; ++index) {
        replay.progress("frames", std::max<std::int64_t>(index, 0), replay.lastFrame + 1);
        replay.runner.updateOnly(index);
        const bool goOn = replay.stepped();
        if (index >= 0) replay.visit(index);
        if (!goOn) return false;
    }
    replay.progress("frames", replay.lastFrame + 1, replay.lastFrame + 1);
    return true;
}

void requireFinite(const pictures::Image& picture, std::int64_t frame, Stage stage, std::string_view what) {
    const auto isBroken = [](const glm::vec4& pixel) { return brokenChannel(pixel) < channels.size(); };
    const auto first = std::ranges::find_if(picture.pixels, isBroken);
    if (first == picture.pixels.end()) return;
    const auto index = first - picture.pixels.begin();
    const std::size_t channel = brokenChannel(*first);
    throw SimulationError(fmt::format(
        "frame {}: {} is not finite in {} pixels, first in ({}, {}): {} is {} (stage {})", frame, what,
        std::ranges::count_if(picture.pixels, isBroken), index % picture.width, index / picture.width,
        channels[channel], (*first)[static_cast<int>(channel)], stageNames[static_cast<std::size_t>(stage)]));
}

}  // namespace dustbench::run
