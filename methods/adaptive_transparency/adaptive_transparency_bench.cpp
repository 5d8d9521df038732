// Benchmarks adaptive transparency: a frame of 320×240 pixels of puffs of several colours in front of an eye, by nodes.
#include <benchmark/benchmark.h>

#include <random>
#include <stdexcept>

#include "methods/adaptive_transparency/adaptive_transparency.h"
#include "methods/kit/testing/test_moment.h"

namespace dustbench::adaptive_transparency {
namespace {

class Workload : public TestMoment {
 public:
    explicit Workload(std::size_t count) : TestMoment(count, 320, 240, {0, 2, 0}, {0, -0.05, -1}) {
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

void frame(benchmark::State& state, int nodes) {
    Workload work(static_cast<std::size_t>(state.range(0)));
    AdaptiveTransparency method(Puff::surface, 3.5, nodes);
    method.prepare(work.scene, {}, Workload::device());
    double alpha = 0;
    for (const glm::vec4& pixel : work.updateAndDraw(method).pixels) alpha += static_cast<double>(pixel.a);
    if (!(alpha > 250)) throw std::runtime_error("the picture shows no dust");
    for (auto _ : state) {
        method.update(work.frame());
        method.draw(work.frame(), work.layer());
        Workload::device().finish();
    }
    state.SetItemsProcessed(state.iterations() * state.range(0));
}
BENCHMARK_CAPTURE(frame, nodes4, 4)->Arg(1'000)->Arg(5'000)->UseRealTime()->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(frame, nodes8, 8)->Arg(1'000)->Arg(5'000)->UseRealTime()->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(frame, nodes32, 32)->Arg(1'000)->UseRealTime()->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace dustbench::adaptive_transparency
