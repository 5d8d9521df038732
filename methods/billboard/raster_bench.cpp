// Benchmarks sorted billboards of 8 pixels at 1920×1080 from dust in GPU buffers: by hardware and in tiles.
//
// The column Time is the median of whole frames after a warm-up: sort, gather, bin, blend. The stages are timed apart
// from them, one after the other. All times are from timer queries where they are true (not on llvmpipe), else until
// the GPU has finished. `differ`: share of the pixels whose alpha differs by more than 1e-3 from that of the hardware;
// `largest`: the largest difference. `blend_ms` of hardware is its draw call.
//
// Puffs are spread over the picture (`spread`), or over a ninth of its width and height, as a distant cloud (`cloud`).
#include <benchmark/benchmark.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <functional>
#include <map>
#include <memory>
#include <random>
#include <string>
#include <string_view>
#include <vector>

#include "methods/billboard/billboard.h"
#include "methods/kit/draw/test_canvas.h"
#include "methods/kit/gpu/queue_marks.h"

namespace dustbench::billboard {
namespace {

using RasterClock = std::chrono::steady_clock;

double medianOfTimes(std::vector<double> values) {
    std::ranges::nth_element(values, values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2));
    return values[values.size() / 2];
}

/// Puffs in GPU buffers, in random order, whose quads have a given edge in the picture.
class GpuDustInView : public draw::TestCanvas {
 public:
    GpuDustInView(std::uint32_t count, double edgePixels, double share)
        : TestCanvas(1920, 1080, {0, 0, 0}, {0, 0, -1}) {
        const glm::mat4 clip = view.eyeToClip();
        std::mt19937 random(1);
        const auto side = static_cast<float>(share);
        std::uniform_real_distribution<float> across(-side, side), away(20, 60), tone(0, 1);
        std::vector<float> positions, looks, colours;
        for (std::uint32_t i = 0; i < count; ++i) {
            const float axis = away(random);
            const glm::vec3 place(across(random) * axis / clip[0][0], across(random) * axis / clip[1][1], -axis);
            // Quads have half-side 1.5 r; away from the image centre perspective stretches them slightly.
            const float radius = static_cast<float>(edgePixels / view.height) * axis / clip[1][1] / 1.5f;
            for (int c = 0; c < 3; ++c) positions.push_back(place[c]), colours.push_back(tone(random));
            looks.insert(looks.end(), {radius, 0.1f});
        }
        const std::vector<std::uint32_t> numbers{count, (count + 255) / 256, 1, 1};
        position_ = {device(), "position", std::span<const float>(positions)};
        look_ = {device(), "look", std::span<const float>(looks)};
        colour_ = {device(), "colour", std::span<const float>(colours)};
        tally_ = {device(), "tally", std::span<const std::uint32_t>(numbers)};
        dust_.position = &position_, dust_.look = &look_, dust_.colour = &colour_, dust_.tally = &tally_;
        dust_.bound = count;
    }
    [[nodiscard]] const GpuPuffs& dust() const { return dust_; }

 private:
    gpu::Buffer position_, look_, colour_, tally_;
    GpuPuffs dust_;
};

/// Times the stages and details of a method that do not contain others.
class StageTimes final : public StageListener {
 public:
    void begin(Stage stage) override { start(stageNames[static_cast<std::size_t>(stage)]); }
    void end(Stage) override { stop(); }
    void beginDetail(std::string_view name) override { start(name); }
    void endDetail(std::string_view) override { stop(); }

    void start(std::string_view name) {
        name_ = name;
        draw::TestCanvas::device().finish();
        begin_ = RasterClock::now();
        query_.begin();
    }
    void stop() {
        query_.end();
        draw::TestCanvas::device().finish();
        const double elapsed = std::chrono::duration<double, std::milli>(RasterClock::now() - begin_).count();
        std::optional<double> queried;
        while (isTrue_ && !queried) queried = query_.milliseconds();
        times[std::string(name_)].push_back(queried.value_or(elapsed));
    }

    std::map<std::string, std::vector<double>> times;

 private:
    gpu::TimerQuery query_{draw::TestCanvas::device()};
    bool isTrue_ = gpu::timerQueriesAreTrue(draw::TestCanvas::device());
    std::string_view name_;
    RasterClock::time_point begin_;
};

class RasterFrames {
 public:
    RasterFrames(std::uint32_t count, bool cloud) : canvas_(count, 8, cloud ? 1.0 / 9 : 0.98) {}

    pictures::Image draw(Raster raster) {
        Billboard method({.raster = raster});
        method.prepare(scene_, {}, draw::TestCanvas::device());
        method.update(frame(StageClock()));
        return canvas_.picture([&](gpu::Layer& layer) { method.draw(frame(StageClock()), layer); });
    }
    /// Medians by stage; `frame`: the whole.
    std::map<std::string, double> measure(Raster raster) {
        constexpr int warmUps = 5, repetitions = 25;
        Billboard method({.raster = raster});
        method.prepare(scene_, {}, draw::TestCanvas::device());
        StageTimes whole, stages;
        const StageClock listening(&stages), deaf;
        const auto started = RasterClock::now();
        for (int i = 0; i < warmUps + repetitions; ++i) {
            if (i == warmUps) whole.times.clear(), stages.times.clear();
            canvas_.layer().clear();
            whole.start("frame");
            method.update(frame(deaf));
            method.draw(frame(deaf), canvas_.layer());
            whole.stop();
            method.update(frame(listening));
            if (raster == Raster::tiles) {
                method.draw(frame(listening), canvas_.layer());
            } else {
                stages.start("blend");
                method.draw(frame(deaf), canvas_.layer());
                stages.stop();
            }
            // A software renderer takes seconds.
            if (whole.times["frame"].size() >= 3 && RasterClock::now() - started > std::chrono::seconds(5)) break;
        }
        std::map<std::string, double> medians{{"frame", medianOfTimes(whole.times["frame"])}};
        for (const auto& [name, times] : stages.times) medians[name] = medianOfTimes(times);
        for (const MemoryUse& use : method.memory()) gpuBytes += use.gpuBytes;
        return medians;
    }

    std::size_t gpuBytes = 0;

 private:
    [[nodiscard]] Frame frame(const StageClock& clock) {
        Puffs none;
        none.uniformColour = false;
        return {0, 1.0 / 60, state_, none, canvas_.view, clock, &canvas_.dust()};
    }

    GpuDustInView canvas_;
    scene::Scene scene_;
    scene::SceneState state_;
};

void raster(benchmark::State& state, Raster raster, bool cloud) {
    RasterFrames frames(static_cast<std::uint32_t>(state.range(0)), cloud);
    const pictures::Image hardware = frames.draw(Raster::hardware), picture = frames.draw(raster);
    double largest = 0, different = 0, depth = 0;
    for (std::size_t i = 0; i < picture.pixels.size(); ++i) {
        const glm::vec4 difference = glm::abs(picture.pixels[i] - hardware.pixels[i]);
        largest =
            std::max(largest, static_cast<double>(std::max({difference.r, difference.g, difference.b, difference.a})));
        different += difference.a > 1e-3f ? 1 : 0;
        depth -= std::log1p(-std::min(static_cast<double>(hardware.pixels[i].a), 1 - 1e-7));
    }
    if (!(depth > 0)) return state.SkipWithError("the picture is empty");
    std::map<std::string, double> medians;
    for (auto _ : state) {
        medians = frames.measure(raster);
        state.SetIterationTime(medians["frame"] * 1e-3);
    }
    for (const auto& [name, milliseconds] : medians)
        if (name != "frame") state.counters[name + "_ms"] = milliseconds;
    state.counters["largest"] = largest;
    state.counters["differ"] = different / static_cast<double>(picture.pixels.size());
    state.counters["gpu_mb"] = static_cast<double>(frames.gpuBytes) * 1e-6;
    state.SetLabel(draw::TestCanvas::device().info().renderer);
}
#define RASTER(name, ...)                        \
    BENCHMARK_CAPTURE(raster, name, __VA_ARGS__) \
        ->Arg(10'000)                            \
        ->Arg(100'000)                           \
        ->Arg(1'000'000)                         \
        ->UseManualTime()                        \
        ->Iterations(1)                          \
        ->Unit(benchmark::kMillisecond)
RASTER(spread_tiles, Raster::tiles, false);
RASTER(spread_hardware, Raster::hardware, false);
RASTER(cloud_tiles, Raster::tiles, true);
RASTER(cloud_hardware, Raster::hardware, true);

}  // namespace
}  // namespace dustbench::billboard
