// Compares the time of drawing points and lines by a system with a bare loop that uploads and draws the same.
//
// The bare loop writes the columns into the instance buffer one particle after another, draws with the same shader into
// the same layer, and waits. Before timing, both pictures are compared.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <chrono>
#include <random>
#include <stdexcept>

#include "methods/kit/draw/points.h"
#include "methods/kit/particles/part.h"
#include "methods/kit/testing/test_moment.h"
#include "methods/plugin_particles/system_picture.h"

namespace dustbench::plugin_particles {
namespace {

constexpr float stepSeconds = 1.0f / 60;

class Workload : public TestMoment {
 public:
    explicit Workload(std::size_t count) : TestMoment(count, 800, 600, {0, 0, 0}, {0, 0, -1}) {
        const glm::mat4 clip = view.eyeToClip();
        std::mt19937 random(1);
        std::uniform_real_distribution<float> across(-0.95f, 0.95f), away(20, 60), some(0.1f, 1);
        dust.keepOneColour(false);
        for (std::size_t i = 0; i < count; ++i) {
            const float axis = away(random);
            dust.serial[i] = i;
            dust.x[i] = across(random) * axis / clip[0][0];
            dust.y[i] = across(random) * axis / clip[1][1];
            dust.z[i] = -axis;
            dust.velocityX[i] = 8 * across(random);
            dust.velocityY[i] = 8 * across(random);
            dust.velocityZ[i] = 8 * across(random);
            dust.red[i] = some(random), dust.green[i] = some(random), dust.blue[i] = some(random);
            dust.opacity[i] = 0.05f, dust.radius[i] = 0.1f;
            dust.age[i] = 1, dust.lifetime[i] = 2;
        }
    }
};

void uploadPlainly(const particles::ParticleStore& d, draw::Points& points) {
    float* value = points.map(d.size(), draw::Points::layout()).data();
    for (std::size_t i = 0; i < d.size(); ++i)
        for (const float next : {d.x[i], d.y[i], d.z[i], d.radius[i], d.opacity[i], d.red[i], d.green[i], d.blue[i]})
            *value++ = next;
    points.unmap();
}

void uploadPlainly(const particles::ParticleStore& d, draw::Lines& lines) {
    float* value = lines.map(d.size(), draw::Lines::layout()).data();
    for (std::size_t i = 0; i < d.size(); ++i)
        for (const float next : {d.x[i], d.y[i], d.z[i], d.velocityX[i], d.velocityY[i], d.velocityZ[i], d.opacity[i],
                                 d.red[i], d.green[i], d.blue[i]})
            *value++ = next;
    lines.unmap();
}

template <typename Pass>
class BareLoop {
 public:
    template <typename Style>
    BareLoop(Workload& work, const Style& style) : work_(work), pass_(work.device(), style) {}

    void operator()() {
        uploadPlainly(work_.dust, pass_);
        pass_.draw(work_.view, work_.layer());
        work_.device().finish();
    }

 private:
    Workload& work_;
    Pass pass_;
};

class System {
 public:
    System(Workload& work, const char* part, const particles::NamedValues& values)
        : work_(work),
          picture_(work.device(),
                   particles::makePartOf<particles::RenderPart>(particles::PartKind::render, part, values)->look(),
                   work.scene.lights) {}

    void operator()() {
        picture_.upload({work_.dust, glm::vec3(0), stepSeconds}, StageClock());
        picture_.draw(work_.view, work_.layer());
        work_.device().finish();
    }

 private:
    Workload& work_;
    SystemPicture picture_;
};

pictures::Image pictureOf(Workload& work, auto& loop) {
    return work.picture([&](const gpu::Layer&) { loop(); });
}

double millisecondsOf(Workload& work, auto& loop) {
    work.layer().clear();
    work.device().finish();
    const auto start = std::chrono::steady_clock::now();
    loop();
    return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
}

double median(std::vector<double> values) {
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    return *middle;
}

/// Alternates both. `share_of_bare` is the median over the rounds of bare / system time: 1 means no overhead.
void inTurns(benchmark::State& state, Workload& work, auto& bare, auto& system) {
    const pictures::Image a = pictureOf(work, bare), b = pictureOf(work, system);
    for (std::size_t i = 0; i < a.pixels.size(); ++i)
        for (int c = 0; c < 4; ++c)
            if (std::abs(a.pixels[i][c] - b.pixels[i][c]) > 1e-4f)
                throw std::runtime_error("the two loops draw different pictures");
    std::vector<double> shares;
    for (auto _ : state) {
        const bool bareFirst = shares.size() % 2 == 0;
        const double first = bareFirst ? millisecondsOf(work, bare) : millisecondsOf(work, system);
        const double second = bareFirst ? millisecondsOf(work, system) : millisecondsOf(work, bare);
        shares.push_back(bareFirst ? first / second : second / first);
        state.SetIterationTime((bareFirst ? second : first) / 1000);
    }
    state.counters["share_of_bare"] = median(shares);
}

void points(benchmark::State& state) {
    Workload work(static_cast<std::size_t>(state.range(0)));
    BareLoop<draw::Points> bare(work, draw::PointStyle{.pixels = 2, .additive = true});
    System system(work, "points", {{"clamped", "off"}});
    inTurns(state, work, bare, system);
}
void lines(benchmark::State& state) {
    Workload work(static_cast<std::size_t>(state.range(0)));
    BareLoop<draw::Lines> bare(work, draw::LineStyle{.seconds = stepSeconds, .additive = true, .fade = true});
    System system(work, "lines", {{"clamped", "off"}});
    inTurns(state, work, bare, system);
}
BENCHMARK(points)
    ->Arg(10'000)
    ->Arg(100'000)
    ->Arg(1'000'000)
    ->UseManualTime()
    ->Unit(benchmark::kMillisecond)
    ->MinTime(4);
BENCHMARK(lines)->Arg(10'000)->Arg(100'000)->Arg(1'000'000)->UseManualTime()->Unit(benchmark::kMillisecond)->MinTime(4);

/// Times each way to draw 10,000 particles.
void way(benchmark::State& state, const char* part, const particles::NamedValues& values) {
    Workload work(10'000);
    System system(work, part, values);
    (void)pictureOf(work, system);
    for (auto _ : state) state.SetIterationTime(millisecondsOf(work, system) / 1000);
}
#define WAY(name, part, ...)                                               \
    BENCHMARK_CAPTURE(way, name, part, particles::NamedValues __VA_ARGS__) \
        ->UseManualTime()                                                  \
        ->Unit(benchmark::kMillisecond)                                    \
        ->MinTime(1)
WAY(points, "points", {});
WAY(points_unclamped, "points", {{"clamped", "off"}});
WAY(lines, "lines", {});
WAY(hybrid, "hybrid", {});
WAY(sprites, "sprites", {});
WAY(aa_copies, "aa_sprites", {});
WAY(aa_accumulation, "aa_sprites", {{"by", "accumulation"}});
WAY(stereo, "points", {{"stereo", "on"}});

}  // namespace
}  // namespace dustbench::plugin_particles
