// Benchmarks exact tiles at 640×480 on a trail like the default scene's over level ground, seen by the chase camera
// and from within the trail; with one colour and two; whole frames and the lists alone.
#include <benchmark/benchmark.h>

#include <cmath>
#include <random>
#include <stdexcept>

#include "methods/exact_tiles/exact_tiles.h"
#include "methods/kit/testing/test_moment.h"

namespace dustbench::exact_tiles {
namespace {

enum class Place { chasing, within };

class Trail : public TestMoment {
 public:
    Trail(std::size_t count, Place place, bool oneColour)
        : TestMoment(count, 640, 480, place == Place::chasing ? glm::dvec3(6.8, 2.5, 9.4) : glm::dvec3(-20, 1, 0.5),
                     place == Place::chasing ? glm::dvec3(-11, -1.3, -9.4) : glm::dvec3(-40, 0, -0.5)) {
        std::mt19937 random(7);
        std::uniform_real_distribution<float> uniform(0, 1);
        const auto centred = [&] { return 2 * uniform(random) - 1; };
        dust.keepOneColour(oneColour);
        for (std::size_t i = 0; i < count; ++i) {
            const float age = uniform(random), rest = 1 - age;
            dust.serial[i] = i;
            dust.x[i] = -80 * age + centred();
            dust.y[i] = 0.1f + uniform(random) * (0.3f + 1.7f * std::sqrt(age));
            dust.z[i] = (i % 2 ? 0.78f : -0.78f) + centred() * (0.2f + 1.5f * age) - 3 * age;
            dust.radius[i] = 0.25f + 1.35f * age;
            dust.opacity[i] = 0.25f * rest * rest * rest + 0.21f * rest * rest * age + 0.075f * rest * age * age;
            dust.lifetime[i] = 4;
            dust.age[i] = 4 * age;
            if (!oneColour) {
                dust.red[i] = i % 2 ? 0.7f : 0.3f;
                dust.green[i] = 0.4f;
                dust.blue[i] = i % 2 ? 0.2f : 0.5f;
            }
        }
        dust.colourOfAll = {0.75f, 0.6f, 0.45f};
        setGround(view.camera.eye.y);
    }
};

void wholeFrame(benchmark::State& state, Place place, bool oneColour) {
    Trail trail(static_cast<std::size_t>(state.range(0)), place, oneColour);
    ExactTiles method({});
    method.prepare(trail.scene, {}, Trail::device());
    double alpha = 0;
    for (const glm::vec4& pixel : trail.updateAndDraw(method).pixels) alpha += static_cast<double>(pixel.a);
    if (!(alpha > 1000)) throw std::runtime_error("the picture shows no dust");
    for (auto _ : state) {
        method.update(trail.frame());
        method.draw(trail.frame(), trail.layer());
        Trail::device().finish();
    }
    state.counters["mean_alpha"] = alpha / (640 * 480);
}
void lists(benchmark::State& state, Place place) {
    const Trail trail(static_cast<std::size_t>(state.range(0)), place, true);
    MemoryLedger ledger;
    PuffTiles tiles(ledger);
    for (auto _ : state) tiles.build(trail.dust, trail.view, 1e-6, Along::back);
    state.counters["entries"] = static_cast<double>(tiles.entries().size());
}

void settings(benchmark::internal::Benchmark* benchmark) {
    benchmark->Unit(benchmark::kMillisecond)->UseRealTime();
}
BENCHMARK_CAPTURE(wholeFrame, chasing, Place::chasing, true)->Arg(1'000)->Arg(5'000)->Apply(settings);
BENCHMARK_CAPTURE(wholeFrame, within, Place::within, true)->Arg(5'000)->Apply(settings);
BENCHMARK_CAPTURE(wholeFrame, chasing_two_colours, Place::chasing, false)->Arg(5'000)->Apply(settings);
BENCHMARK_CAPTURE(lists, chasing, Place::chasing)->Arg(1'000)->Arg(5'000)->Arg(50'000)->Apply(settings);
BENCHMARK_CAPTURE(lists, within, Place::within)->Arg(5'000)->Apply(settings);

}  // namespace
}  // namespace dustbench::exact_tiles
