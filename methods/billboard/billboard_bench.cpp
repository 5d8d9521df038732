// Benchmarks 10,000 sorted billboards of 32 pixels: the whole method against a bare loop with the same shader, target
// and puffs.
//
// The bare loop binds, draws and waits; its buffer is written once, in order. Before timing, the two pictures are
// compared. Their coverage is checked against that of the puffs, because quads that fail the depth test are cheap.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <random>
#include <stdexcept>

#include "methods/billboard/billboard.h"
#include "methods/kit/testing/test_moment.h"

namespace dustbench::billboard {
namespace {

constexpr float opacity = 0.1f;

class Workload : public TestMoment {
 public:
    Workload(std::size_t count, double edgePixels) : TestMoment(count, 800, 600, {0, 0, 0}, {0, 0, -1}) {
        const glm::mat4 clip = view.eyeToClip();
        std::mt19937 random(1);
        std::uniform_real_distribution<float> across(-0.95f, 0.95f), away(20, 60);
        for (std::size_t i = 0; i < count; ++i) {
            const float axis = away(random);
            dust.serial[i] = i;
            dust.x[i] = across(random) * axis / clip[0][0];
            dust.y[i] = across(random) * axis / clip[1][1];
            dust.z[i] = -axis;
            // Quads have half-side 1.5 r; away from the image centre perspective stretches them slightly.
            dust.radius[i] = static_cast<float>(edgePixels / view.height) * axis / clip[1][1] / 1.5f;
            dust.opacity[i] = opacity;
            dust.lifetime[i] = 5;
            dust.age[i] = across(random) + 2;
        }
        dust.colourOfAll = {0.6f, 0.5f, 0.4f};
    }

    void clear() {
        layer().clear();
        device().finish();
    }
};

/// The draw pass alone; its instances are written once, in order.
class BareLoop {
 public:
    explicit BareLoop(Workload& work) : work_(work), quads_(work.device(), {}) {
        MemoryLedger ledger;
        draw::DepthSort sort(ledger);
        const auto& dust = work.dust;
        const auto layout = quads_.layout(false);
        float* value = quads_.map(dust.size(), layout).data();
        for (const std::uint32_t i : sort.farToNear(draw::SortKind::quicksort, {dust.x, dust.y, dust.z}, glm::vec3(0)))
            for (const float next : {dust.x[i], dust.y[i], dust.z[i], dust.radius[i], dust.opacity[i]}) *value++ = next;
        quads_.unmap();
    }

    void operator()() {
        quads_.draw(work_.view, work_.dust.colourOfAll, work_.layer());
        work_.device().finish();
    }

 private:
    Workload& work_;
    draw::Billboards quads_;
};

class WholeMethod {
 public:
    WholeMethod(Workload& work, const Settings& settings) : work_(work), method_(settings) {
        method_.prepare(work.scene, {}, work.device());
    }

    void operator()() {
        method_.update(work_.frame());
        method_.draw(work_.frame(), work_.layer());
        work_.device().finish();
    }

 private:
    Workload& work_;
    Billboard method_;
};

pictures::Image pictureOf(Workload& work, auto& loop) {
    return work.picture([&](const gpu::Layer&) { loop(); });
}

/// Throws unless the picture shows the puffs' mass.
void verify(Workload& work, const pictures::Image& bare, const pictures::Image& whole) {
    if (bare.pixels != whole.pixels) throw std::runtime_error("the two loops draw different pictures");
    // Compares the picture's total optical depth with the puffs' masses: τ·2πs²·f²/(distance along the axis)², in
    // pixels.
    const double focal = static_cast<double>(work.view.eyeToClip()[1][1]) * work.view.height / 2;
    double expected = 0, got = 0;
    for (std::size_t i = 0; i < work.dust.size(); ++i) {
        const double s = static_cast<double>(work.dust.radius[i]) / 2;
        const double axis = -static_cast<double>(work.dust.z[i]);
        const double stretch = glm::length(glm::dvec3(work.dust.position(i))) / axis;  // of a quad off the axis
        expected += -std::log1p(-static_cast<double>(opacity)) * 2 * 3.14159265 * s * s * focal * focal /
                    (axis * axis) * stretch;
    }
    for (const glm::vec4& pixel : bare.pixels) got -= std::log1p(-static_cast<double>(pixel.a));
    if (std::abs(got / expected - 1) > 0.05)
        throw std::runtime_error("the picture shows " + std::to_string(got / expected) + " of the puffs' mass");
}

double millisecondsOf(auto& loop) {
    const auto start = std::chrono::steady_clock::now();
    loop();
    return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
}

double median(std::vector<double> values) {
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    return *middle;
}

/// Alternates both loops. `share_of_bare` is the median over the rounds of bare / whole time: 1 means no overhead.
void wholeMethodAgainstBareLoop(benchmark::State& state) {
    const auto count = static_cast<std::size_t>(state.range(0));
    Workload work(count, static_cast<double>(state.range(1)));
    BareLoop bare(work);
    WholeMethod whole(work, {});
    verify(work, pictureOf(work, bare), pictureOf(work, whole));

    std::vector<double> bareTimes, wholeTimes, shares;
    for (auto _ : state) {
        const auto timed = [&](auto& loop, std::vector<double>& times) {
            work.clear();
            times.push_back(millisecondsOf(loop));
        };
        if (bareTimes.size() % 2 == 0) {
            timed(bare, bareTimes);
            timed(whole, wholeTimes);
        } else {
            timed(whole, wholeTimes);
            timed(bare, bareTimes);
        }
        shares.push_back(bareTimes.back() / wholeTimes.back());
        state.SetIterationTime(wholeTimes.back() / 1000);
    }
    const double quads = static_cast<double>(count);
    state.counters["bare_ns_per_quad"] = median(bareTimes) * 1e6 / quads;
    state.counters["whole_ns_per_quad"] = median(wholeTimes) * 1e6 / quads;
    state.counters["share_of_bare"] = median(shares);
}
BENCHMARK(wholeMethodAgainstBareLoop)
    ->ArgNames({"quads", "pixels"})
    ->Args({10'000, 32})
    ->Args({100'000, 8})
    ->UseManualTime()
    ->Unit(benchmark::kMillisecond)
    ->MinTime(8);

/// One frame of each mode.
void mode(benchmark::State& state, const Settings& settings) {
    Workload work(10'000, 32);
    WholeMethod whole(work, settings);
    (void)pictureOf(work, whole);
    for (auto _ : state) {
        work.clear();
        state.SetIterationTime(millisecondsOf(whole) / 1000);
    }
}
#define MODE(name, ...) \
    BENCHMARK_CAPTURE(mode, name, Settings __VA_ARGS__)->UseManualTime()->Unit(benchmark::kMillisecond)->MinTime(2)
MODE(gaussian, {});
MODE(viewplane, {.style = {draw::Facing::viewplane, false}});
MODE(soft, {.style = {draw::Facing::viewpoint, true}});
MODE(texture, {.puff = Puff::texture});
MODE(textures, {.puff = Puff::textures});
MODE(animated, {.puff = Puff::animated});

/// Sort and upload only: the CPU's work per frame.
void update(benchmark::State& state, draw::SortKind sort) {
    Workload work(static_cast<std::size_t>(state.range(0)), 1);
    Billboard method({.sort = sort});
    method.prepare(work.scene, {}, work.device());
    const StageClock clock;
    const Frame frame{0, 1.0 / 60, work.state, work.dust, work.view, clock};
    for (auto _ : state) method.update(frame);
    state.SetItemsProcessed(state.iterations() * state.range(0));
}
BENCHMARK_CAPTURE(update, radix, draw::SortKind::radix)
    ->Arg(10'000)
    ->Arg(100'000)
    ->Arg(1'000'000)
    ->UseRealTime()
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(update, none, draw::SortKind::none)
    ->Arg(10'000)
    ->Arg(1'000'000)
    ->UseRealTime()
    ->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace dustbench::billboard
