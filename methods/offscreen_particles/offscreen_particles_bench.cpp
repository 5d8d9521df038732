// Benchmarks off-screen particles: a frame of 640×480 pixels of wide puffs behind a wall that covers half of it.
#include <benchmark/benchmark.h>

#include <random>
#include <stdexcept>

#include "methods/kit/testing/test_moment.h"
#include "methods/offscreen_particles/offscreen_particles.h"

namespace dustbench::offscreen_particles {
namespace {

class Workload : public TestMoment {
 public:
    explicit Workload(std::size_t count) : TestMoment(count, 640, 480, {0, 2, 0}, {0, 0, -1}) {
        std::mt19937 random(1);
        std::uniform_real_distribution<float> uniform(0, 1);
        for (std::size_t i = 0; i < count; ++i) {
            dust.serial[i] = i;
            dust.z[i] = -8 - 20 * uniform(random);
            dust.x[i] = (uniform(random) - 0.5f) * -dust.z[i];
            dust.y[i] = 4 * uniform(random);
            dust.radius[i] = 1 + uniform(random);
            dust.opacity[i] = 0.2f * uniform(random);
            dust.lifetime[i] = 4;
        }
        dust.colourOfAll = {0.6f, 0.5f, 0.4f};
        setWall(5, 320);
    }
};

void frame(benchmark::State& state, Edges edges) {
    Workload work(1'000);
    OffscreenParticles method({static_cast<int>(state.range(0)), Upsampling::depth, edges});
    method.prepare(work.scene, {}, Workload::device());
    double alpha = 0;
    for (const glm::vec4& pixel : work.updateAndDraw(method).pixels) alpha += static_cast<double>(pixel.a);
    if (!(alpha > 1000)) throw std::runtime_error("the picture shows no dust");
    for (auto _ : state) {
        method.update(work.frame());
        method.draw(work.frame(), work.layer());
        Workload::device().finish();
    }
}
BENCHMARK_CAPTURE(frame, mixed, Edges::mixed)->Arg(2)->Arg(4)->UseRealTime()->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(frame, none, Edges::none)->Arg(2)->Arg(4)->UseRealTime()->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace dustbench::offscreen_particles
