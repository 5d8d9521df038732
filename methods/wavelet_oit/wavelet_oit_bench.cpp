// Benchmarks wavelets: a frame of 640×480 pixels of puffs of several colours in front of an eye, by rank.
#include "methods/wavelet_oit/wavelet_oit.h"

#include <benchmark/benchmark.h>

#include <random>
#include <stdexcept>

#include "methods/kit/testing/test_moment.h"

namespace dustbench::wavelet_oit {
namespace {

class Workload : public TestMoment {
 public:
    explicit Workload(std::size_t count) : TestMoment(count, 640, 480, {0, 2, 0}, {0, -0.05, -1}) {
        std::mt19937 random(1);
        std::uniform_real_distribution<float> uniform(0, 1);
        dust.keepOneColour(false);
        for (std::size_t i = 0; i < count; ++i) {
            dust.serial[i] = i;
            dust.z[i] = -8 - 60 * uniform(random);
            dust.x[i] = (uniform(random) - 0.5f) * -dust.z[i];
            dust.y[i] = 3 * uniform(random);
            dust.radius[i] = 0.25f + 1.35f * uniform(random);
            dust.opacity[i] = 0.2f * uniform(random);
            dust.lifetime[i] = 4;
            dust.red[i] = uniform(random), dust.green[i] = 0.4f, dust.blue[i] = uniform(random);
        }
        setGround(2);
    }
};

void frame(benchmark::State& state, const Settings& settings) {
    Workload work(static_cast<std::size_t>(state.range(0)));
    WaveletOit method(settings);
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
void loads(benchmark::internal::Benchmark* benchmark) {
    benchmark->Arg(1'000)->Arg(5'000)->UseRealTime()->Unit(benchmark::kMillisecond);
}
BENCHMARK_CAPTURE(frame, rank2, {.rank = 2})->Apply(loads);
BENCHMARK_CAPTURE(frame, rank3, {.rank = 3})->Apply(loads);
BENCHMARK_CAPTURE(frame, rank3_packed, {.rank = 3, .storage = Storage::halves})->Apply(loads);
BENCHMARK_CAPTURE(frame, rank3_volumes, {.rank = 3, .puff = Puff::volume})->Apply(loads);
BENCHMARK_CAPTURE(frame, rank3_pixel_bounds, {.rank = 3, .bounds = Bounds::pixel})->Apply(loads);
BENCHMARK_CAPTURE(frame, rank4, {.rank = 4})->Apply(loads);

}  // namespace
}  // namespace dustbench::wavelet_oit
