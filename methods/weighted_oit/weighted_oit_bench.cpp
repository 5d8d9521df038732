// Benchmarks weighted sums: a frame of 640×480 pixels of puffs in front of an eye, of one colour and of several.
#include <benchmark/benchmark.h>

#include <random>
#include <stdexcept>

#include "methods/kit/testing/test_moment.h"
#include "methods/weighted_oit/weighted_oit.h"

namespace dustbench::weighted_oit {
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

void frame(benchmark::State& state, bool oneColour) {
    Workload work(static_cast<std::size_t>(state.range(0)), oneColour);
    WeightedOit method({.reachDeviations = 4});
    run(state, method, work);
}
BENCHMARK_CAPTURE(frame, one_colour, true)->Arg(1'000)->Arg(5'000)->UseRealTime()->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(frame, colours, false)->Arg(5'000)->UseRealTime()->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace dustbench::weighted_oit
