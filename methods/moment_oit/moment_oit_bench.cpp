// Benchmarks moments: a frame of 640×480 pixels of puffs in front of an eye, of one colour and of several.
#include <benchmark/benchmark.h>

#include <random>
#include <stdexcept>

#include "methods/kit/testing/test_moment.h"
#include "methods/moment_oit/moment_oit.h"

namespace dustbench::moment_oit {
namespace {

class Workload : public TestMoment {
 public:
    Workload(std::size_t count, bool oneColour) : TestMoment(count, 640, 480, {0, 2, 0}, {0, -0.05, -1}) {
        std::mt19937 random(1);
        std::uniform_real_distribution<float> uniform(0, 1);
        dust.keepOneColour(oneColour);
        for (std::size_t i = 0; i < count; ++i) {
            dust.serial[i] = i;
            dust.z[i] = -8 - 60 * uniform(random);
            dust.x[i] = (uniform(random) - 0.5f) * -dust.z[i];
            dust.y[i] = 3 * uniform(random);
            dust.radius[i] = 0.25f + 1.35f * uniform(random);
            dust.opacity[i] = 0.2f * uniform(random);
            dust.lifetime[i] = 4;
            if (!oneColour) dust.red[i] = uniform(random), dust.green[i] = 0.4f, dust.blue[i] = uniform(random);
        }
        dust.colourOfAll = {0.6f, 0.5f, 0.4f};
        setGround(2);
    }
};

void run(benchmark::State& state, Method& method, Workload& work) {
    method.prepare(work.scene, {}, Workload::device());
    double alpha = 0;
    for (const glm::vec4& pixel : work.updateAndDraw(method).pixels) alpha += static_cast<double>(pixel.a);
    if (!(alpha > 1000)) throw std::runtime_error("the picture shows no dust");
    for (auto _ : state) {
        method.update(work.frame());
        method.draw(work.frame(), work.layer());
        Workload::device().finish();
    }
    state.SetItemsProcessed(state.iterations() * state.range(0));
}

void frame(benchmark::State& state, const Settings& settings) {
    Workload work(static_cast<std::size_t>(state.range(0)), false);
    MomentOit method(settings);
    run(state, method, work);
}
void settings(benchmark::internal::Benchmark* benchmark) {
    benchmark->Arg(1'000)->Arg(5'000)->UseRealTime()->Unit(benchmark::kMillisecond);
}
BENCHMARK_CAPTURE(frame, four, {.kind = {.count = 4}})->Apply(settings);
BENCHMARK_CAPTURE(frame, six, {.kind = {.count = 6}})->Apply(settings);
BENCHMARK_CAPTURE(frame, six_of_points, {.kind = {.count = 6}, .shape = Shape::point})->Apply(settings);
BENCHMARK_CAPTURE(frame, six_three_samples, {.kind = {.count = 6}, .samples = 3})->Apply(settings);

}  // namespace
}  // namespace dustbench::moment_oit
