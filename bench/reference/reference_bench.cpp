// Cost of the ground truth at 640×480: a trail like that of the default scene over level ground, from its chase camera,
// for both references; and from within the trail.
//
// Targets on 2 cores: 1 s for `particles`, 15 s for `continuum`, and 1 s for lit dust of 3,000 puffs at 320×240.
#include <benchmark/benchmark.h>

#include "bench/reference/cloud_march.h"
#include "bench/reference/particle_image.h"
#include "bench/reference/test_clouds.h"

namespace dustbench::reference {
namespace {

enum class Place { chasing, within };

scene::View viewFrom(Place place) {
    scene::View view;
    view.width = 640;
    view.height = 480;
    // The vehicle is at the origin; its trail extends towards −X.
    view.camera.eye = place == Place::chasing ? glm::dvec3(6.8, 2.5, 9.4) : glm::dvec3(-20, 1, 0.5);
    view.camera.target = place == Place::chasing ? glm::dvec3(-4.2, 1.2, 0) : glm::dvec3(-60, 1, 0);
    return view;
}

void render(benchmark::State& state, Place place, double opticalDepthShare) {
    MemoryLedger ledger;
    const particles::ParticleStore store = test::trail(ledger, static_cast<std::size_t>(state.range(0)), 80);
    const scene::View view = viewFrom(place);
    const OpaqueDistances ground = test::groundDistances(view, 0);
    ReferenceOptions options;
    options.opticalDepthShare = opticalDepthShare;
    double evaluations = 0, alpha = 0;
    for (auto _ : state) {
        const CloudImage cloud = renderParticles(store, view, ground, options);
        evaluations += static_cast<double>(cloud.evaluations);
        alpha = 0;
        for (const glm::vec4& pixel : cloud.image.pixels) alpha += static_cast<double>(pixel.a);
    }
    state.counters["evaluations"] = benchmark::Counter(evaluations, benchmark::Counter::kAvgIterations);
    state.counters["evaluations_per_s"] = benchmark::Counter(evaluations, benchmark::Counter::kIsRate);
    state.counters["mean_alpha"] = alpha / (view.width * view.height);
}

void particlesReference(benchmark::State& state, Place place) {
    render(state, place, 1);
}
void continuumReference(benchmark::State& state, Place place) {
    render(state, place, 1.0 / 64);
}

void litReference(benchmark::State& state, Place place) {
    MemoryLedger ledger;
    const particles::ParticleStore store = test::trail(ledger, static_cast<std::size_t>(state.range(0)), 80);
    scene::View view = viewFrom(place);
    view.width = 320;
    view.height = 240;
    const OpaqueDistances ground = test::groundDistances(view, 0);
    const SunLight light = SunLight::of({});
    for (auto _ : state) benchmark::DoNotOptimize(renderLitParticles(store, view, ground, light));
}

void settings(benchmark::internal::Benchmark* benchmark) {
    benchmark->Unit(benchmark::kMillisecond)->UseRealTime()->MeasureProcessCPUTime();
}

BENCHMARK_CAPTURE(particlesReference, chasing, Place::chasing)->Arg(5'000)->Apply(settings);
BENCHMARK_CAPTURE(particlesReference, within, Place::within)->Arg(5'000)->Apply(settings);
BENCHMARK_CAPTURE(litReference, chasing, Place::chasing)->Arg(3'000)->Apply(settings);
BENCHMARK_CAPTURE(litReference, within, Place::within)->Arg(3'000)->Apply(settings);
BENCHMARK_CAPTURE(continuumReference, chasing, Place::chasing)->Arg(320'000)->Apply(settings);
BENCHMARK_CAPTURE(continuumReference, within, Place::within)->Arg(320'000)->Apply(settings);

}  // namespace
}  // namespace dustbench::reference
