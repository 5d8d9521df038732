// Measures one step of structured particles and of flocks.
#include <benchmark/benchmark.h>
#include <tbb/global_control.h>

#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "methods/kit/maths/philox.h"
#include "methods/kit/maths/sampling.h"
#include "methods/kit/particles/flock.h"
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

/// The neighbours of 100,000 boids at 24 and 600 per cubic metre, by lanes and one at a time: their ratio is the gain.
void BM_Neighbours(benchmark::State& bench, bool byLanes) {
    constexpr std::size_t count = 100'000;
    const double radius = std::cbrt(static_cast<double>(count) / (4.19 * static_cast<double>(bench.range(0))));
    std::array<std::vector<float>, 6> columns;
    for (std::size_t i = 0; i < count; ++i) {
        const auto u = maths::uniform4(7, 1, i), v = maths::uniform4(7, 2, i);
        const glm::vec3 p = static_cast<float>(radius) * maths::ballPoint(u[0], u[1], u[2], u[3], v[0]);
        for (int axis = 0; axis < 3; ++axis) {
            columns[static_cast<std::size_t>(axis)].push_back(p[axis]);
            columns[static_cast<std::size_t>(axis) + 3].push_back(v[static_cast<std::size_t>(axis) + 1]);
        }
    }
    const FlockState state{columns[0], columns[1], columns[2], columns[3], columns[4], columns[5]};
    const FlockRules rules{0.3f, 0.5f, 0.3f, 2, 1};
    std::vector<glm::vec3> accelerations(count);
    const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
    Flock flock;
    for (auto _ : bench) {
        if (byLanes)
            flock.accelerate(rules, state, accelerations);
        else
            accelerateOneByOne(rules, state, accelerations);
        benchmark::DoNotOptimize(accelerations.data());
    }
}
BENCHMARK_CAPTURE(BM_Neighbours, lanes, true)->Arg(24)->Arg(600)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(BM_Neighbours, one_by_one, false)->Arg(24)->Arg(600)->Unit(benchmark::kMillisecond);

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
