// Measures the cost of a particle update relative to the machine's memory bandwidth.
//
// `bytes_per_second` counts the bytes that an update must read and write; BM_Triad is the upper bound. The particles
// are wheel dust with all of its parts; births replace deaths of 0.5 % per step.
#include <benchmark/benchmark.h>
#include <tbb/global_control.h>
#include <tbb/parallel_for.h>

#include <cmath>
#include <ctime>
#include <vector>

#include "methods/kit/particles/part.h"
#include "methods/kit/particles/particle_system.h"
#include "source_folder.h"

namespace dustbench::particles {
namespace {

constexpr double stepSeconds = 1.0 / 60;
/// One in two hundred particles dies per step: the mean lifetime is 200 steps.
constexpr double lifetimeSeconds = 200 * stepSeconds;

/// CPU time of all threads. On a busy machine `items_per_cpu_second` times the threads is more reliable than the wall
/// clock.
double cpuSecondsSince(std::clock_t begin) {
    return static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC;
}

scene::Scene sceneWith(bool heightField) {
    scene::Scene scene;
    scene.wind = {1.5f, 0, 0.5f};
    scene.vehicle.emplace();
    if (heightField) {
        constexpr int side = 512;
        std::vector<float> heights(side * side);
        for (int j = 0; j < side; ++j)
            for (int i = 0; i < side; ++i)
                heights[static_cast<std::size_t>(j * side + i)] =
                    static_cast<float>(2 * std::sin(i * 0.05) * std::cos(j * 0.07));
        scene.terrain = scene::Terrain(std::move(heights), side, side, 1, -0.5f * side, -0.5f * side);
    }
    return scene;
}

/// A car that drives in a circle at 20 m/s, so that the cloud stays on the height field.
scene::SceneState stateAt(double timeSeconds, const scene::Scene& scene) {
    constexpr double speed = 20, radius = 60;
    const double angle = timeSeconds * speed / radius;
    scene::SceneState state;
    state.timeSeconds = timeSeconds;
    state.vehicle.speed = speed;
    for (std::size_t i = 0; i < 4; ++i) {
        scene::WheelState& wheel = state.vehicle.wheels[i];
        wheel.forward = {-std::sin(angle), 0, -std::cos(angle)};
        wheel.velocity = speed * wheel.forward;
        const double r = radius + static_cast<double>(i % 2) * 1.5;
        wheel.contact = {r * std::cos(angle), 0, -r * std::sin(angle)};
        wheel.contact.y =
            scene.terrain.heightAt(static_cast<float>(wheel.contact.x), static_cast<float>(wheel.contact.z));
    }
    return state;
}

enum Variant { flat, noGusts, bezierColour, heightField };

void BM_Update(benchmark::State& bench) {
    const auto count = bench.range(0);
    const auto variant = static_cast<Variant>(bench.range(1));
    const tbb::global_control threads(tbb::global_control::max_allowed_parallelism,
                                      static_cast<std::size_t>(bench.range(2)));
    const scene::Scene scene = sceneWith(variant == heightField);
    auto system = ParticleSystem::load(DUSTBENCH_SOURCE_DIR "/data/particles/wheel_dust.toml", 1);
    system.parts().lives().clear();
    system.parts().set(makePart(PartKind::life, "lifetime",
                                {{"average_seconds", std::to_string(lifetimeSeconds)}, {"variation_seconds", "1"}}));
    if (variant == noGusts) {
        std::erase_if(system.parts().forces(), [](const auto& part) { return part->name() == "wind"; });
        system.parts().set(makePart(PartKind::force, "wind"));
    }
    if (variant == bezierColour)
        system.parts().set(makePart(PartKind::colour, "bezier", {{"opacity_curve", "bezier"}, {"late.red", "0.3"}}));

    std::int64_t step = 0;
    const auto advance = [&] {
        ++step;
        const scene::SceneState state = stateAt(static_cast<double>(step) * stepSeconds, scene);
        system.update({scene, state, stepSeconds, count});
    };
    while (step < 320) advance();  // longer than any lifetime, so that births and deaths are in balance

    std::int64_t updated = 0;
    const std::clock_t begin = std::clock();
    for (auto _ : bench) {
        updated += static_cast<std::int64_t>(system.store().size());
        advance();
    }
    bench.SetItemsProcessed(updated);
    bench.counters["items_per_cpu_second"] = static_cast<double>(updated) / cpuSecondsSince(begin);
    // Read: position, velocity, age, lifetime. Written: position, velocity, age, radius, opacity (and three colours).
    const std::int64_t bytes = 32 + 36 + (variant == bezierColour ? 12 : 0);
    bench.SetBytesProcessed(updated * bytes);
    std::size_t held = 0;
    for (const MemoryUse& use : system.memory()) held += use.cpuBytes;
    bench.counters["bytes_held_per_particle"] = static_cast<double>(held) / static_cast<double>(system.store().size());
}

void updateArguments(benchmark::internal::Benchmark* bench) {
    for (const std::int64_t threads : {2, 1}) bench->Args({1'000'000, flat, threads});
    for (const auto variant : {noGusts, bezierColour, heightField}) bench->Args({1'000'000, variant, 2});
    for (const std::int64_t count : {10'000, 100'000}) bench->Args({count, flat, 2});
    bench->Args({10'000, flat, 1});  // fits the cache: measures arithmetic only
    bench->ArgNames({"particles", "variant", "threads"})->UseRealTime()->Unit(benchmark::kMicrosecond);
}
BENCHMARK(BM_Update)->Apply(updateArguments);

/// a ← b + s·c over arrays the size of a million particles' columns: measures memory bandwidth. Bytes are counted as
/// for an update: two reads and one write.
void BM_Triad(benchmark::State& bench) {
    const tbb::global_control threads(tbb::global_control::max_allowed_parallelism,
                                      static_cast<std::size_t>(bench.range(0)));
    constexpr std::size_t count = 6'000'000;
    std::vector<float> a(count), b(count, 1.0f), c(count, 2.0f);
    const std::clock_t begin = std::clock();
    for (auto _ : bench) {
        tbb::parallel_for(tbb::blocked_range<std::size_t>(0, count, 4096), [&](const auto& range) {
            float* __restrict to = a.data();
            const float* __restrict left = b.data();
            const float* __restrict right = c.data();
            for (std::size_t i = range.begin(); i < range.end(); ++i) to[i] = left[i] + 3.0f * right[i];
        });
        benchmark::ClobberMemory();
    }
    const std::int64_t bytes = static_cast<std::int64_t>(bench.iterations() * count * 3 * sizeof(float));
    bench.SetBytesProcessed(bytes);
    bench.counters["bytes_per_cpu_second"] = static_cast<double>(bytes) / cpuSecondsSince(begin);
}
BENCHMARK(BM_Triad)->Arg(2)->Arg(1)->ArgName("threads")->UseRealTime()->Unit(benchmark::kMicrosecond);

}  // namespace
}  // namespace dustbench::particles
