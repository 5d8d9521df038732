// Measures one step of structured particles and of flocks.
#include <benchmark/benchmark.h>
#include <tbb/global_control.h>

#include <cmath>
#include <string>

#include "methods/kit/particles/part_toml.h"
#include "methods/kit/particles/particle_system.h"

namespace dustbench::particles {
namespace {

std::string closedSystem(std::int64_t count, const std::string& position, const std::string& forces) {
    return "emission = { part = \"bursts\", count = " + std::to_string(count) +
           ", duration_seconds = 0, interval_seconds = 1e6 }\nposition = { " + position +
           " }\nvelocity = { part = \"random\", speed = 1.5, variation = 0.3 }\n"
           "colour = { part = \"constant\" }\nsize = { part = \"constant\" }\n"
           "life = [ { part = \"lifetime\", average_seconds = 1e6, variation_seconds = 0 } ]\nforce = [ " +
           forces + " ]\n";
}

void stepAll(benchmark::State& bench, const std::string& toml, int before) {
    const tbb::global_control threads(tbb::global_control::max_allowed_parallelism,
                                      static_cast<std::size_t>(bench.range(1)));
    ParticleSystem system(partsFromText(toml, "bench"), 1);
    const scene::Scene scene;
    const scene::SceneState state;
    for (int i = 0; i < before; ++i) system.update({scene, state, 1.0 / 60});
    std::int64_t updated = 0;
    for (auto _ : bench) {
        system.update({scene, state, 1.0 / 60});
        updated += static_cast<std::int64_t>(system.store().size());
    }
    bench.SetItemsProcessed(updated);
}

/// A flock of 24 boids per cubic metre at the start, one second later.
void BM_Boids(benchmark::State& bench) {
    const std::int64_t count = bench.range(0);
    const double radius = 2 * std::cbrt(static_cast<double>(count) / 800);
    stepAll(bench,
            closedSystem(count, "part = \"sphere\", at = \"place\", radius_metres = " + std::to_string(radius),
                         "{ part = \"boids\", near_metres = 0.3, sight_metres = 0.5, separation = 0.3 }"),
            60);
}
BENCHMARK(BM_Boids)
    ->ArgsProduct({{10'000, 100'000, 1'000'000}, {1, 2}})
    ->ArgNames({"boids", "threads"})
    ->UseRealTime()
    ->Unit(benchmark::kMillisecond);

void BM_Springs(benchmark::State& bench, const char* step) {
    const std::int64_t edge = bench.range(0);
    stepAll(bench,
            closedSystem(edge * edge,
                         "part = \"lattice\", columns = " + std::to_string(edge) + ", rows = " + std::to_string(edge),
                         "{ part = \"springs\", stiffness = 300, step = " + std::string(step) + " }"),
            10);
}
void springsArguments(benchmark::internal::Benchmark* bench) {
    bench->ArgsProduct({{50, 100, 316}, {1, 2}})
        ->ArgNames({"edge", "threads"})
        ->UseRealTime()
        ->Unit(benchmark::kMillisecond);
}
BENCHMARK_CAPTURE(BM_Springs, explicit_step, "\"explicit\"")->Apply(springsArguments);
BENCHMARK_CAPTURE(BM_Springs, position_10_substeps, "\"position\", substeps = 10")->Apply(springsArguments);

}  // namespace
}  // namespace dustbench::particles
