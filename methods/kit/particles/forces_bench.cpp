// Measures the thesis's forces alternately with their references: two discs with the shared dust's update, the sum of
// pairs with a bare loop, the tree with the sum of pairs; and steps of structured particles and of flocks.
#include <benchmark/benchmark.h>
#include <tbb/global_control.h>

#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "methods/kit/maths/philox.h"
#include "methods/kit/maths/sampling.h"
#include "methods/kit/parallel/for_each_block.h"
#include "methods/kit/particles/attraction.h"
#include "methods/kit/particles/flock.h"
#include "methods/kit/particles/part_toml.h"
#include "methods/kit/particles/particle_system.h"
#include "source_folder.h"

namespace dustbench::particles {
namespace {

constexpr double forcesStepSeconds = 1.0 / 60;

/// The thesis's case: points that fall on two discs; births replace deaths of 0.5 % per step.
const std::string twoDiscs = R"(
emission = { part = "stream", rate_per_second = 100 }
position = { part = "sphere", at = "place", place = [0, 4, 0], radius_metres = 1 }
velocity = { part = "cone", half_angle_degrees = 30, speed = 3 }
colour = { part = "constant" }
size = { part = "constant" }
life = [ { part = "lifetime", average_seconds = 3.333333, variation_seconds = 1 } ]
force = [
    { part = "gravity" },
    { part = "bounce", MODE shape = "disc", place = [0, 1, 0], radius_metres = 3 },
    { part = "bounce", MODE shape = "disc", place = [2, 0, 0], normal = [-0.3, 1, 0], radius_metres = 4 },
]
)";

std::string withMode(std::string toml, const std::string& mode) {
    for (std::size_t at = toml.find("MODE"); at != std::string::npos; at = toml.find("MODE")) toml.replace(at, 4, mode);
    return toml;
}

void BM_TwoDiscs(benchmark::State& bench) {
    const auto count = bench.range(0);
    const tbb::global_control threads(tbb::global_control::max_allowed_parallelism,
                                      static_cast<std::size_t>(bench.range(1)));
    ParticleSystem system(partsFromText(withMode(twoDiscs, bench.range(2) ? "mode = \"paper\"," : ""), "bench"), 1);
    const scene::Scene scene;
    const scene::SceneState state;
    for (int i = 0; i < 320; ++i) system.update({scene, state, forcesStepSeconds, count});
    std::int64_t updated = 0;
    for (auto _ : bench) {
        updated += static_cast<std::int64_t>(system.store().size());
        system.update({scene, state, forcesStepSeconds, count});
    }
    bench.SetItemsProcessed(updated);
}
BENCHMARK(BM_TwoDiscs)
    ->Args({1'000'000, 2, 0})
    ->Args({1'000'000, 2, 1})
    ->Args({1'000'000, 1, 0})
    ->ArgNames({"particles", "threads", "paper"})
    ->UseRealTime()
    ->Unit(benchmark::kMicrosecond);

struct Cloud {
    std::vector<float> x, y, z, mass, ax, ay, az;
    explicit Cloud(std::size_t n) : x(n), y(n), z(n), mass(n, 1), ax(n), ay(n), az(n) {
        for (std::size_t i = 0; i < n; ++i) {
            const auto u = maths::uniform4(1, 1, i), v = maths::uniform4(1, 2, i);
            const glm::vec3 p = 10.0f * maths::ballPoint(u[0], u[1], u[2], u[3], v[0]);
            x[i] = p.x, y[i] = p.y, z[i] = p.z;
        }
    }
};

/// Upper bound for the sum of pairs: the same square root and division, one body at a time, nothing else.
void bareLoop(std::size_t bodies, const float* __restrict bx, const float* __restrict by, const float* __restrict bz,
              std::size_t count, const float* __restrict x, const float* __restrict y, const float* __restrict z,
              float* __restrict ax, float* __restrict ay, float* __restrict az, float softening2) {
    for (std::size_t j = 0; j < bodies; ++j)
        for (std::size_t i = 0; i < count; ++i) {
            const float dx = bx[j] - x[i], dy = by[j] - y[i], dz = bz[j] - z[i];
            const float s2 = dx * dx + dy * dy + dz * dz + softening2;
            const float pull = 1.0f / (s2 * std::sqrt(s2));
            ax[i] += pull * dx;
            ay[i] += pull * dy;
            az[i] += pull * dz;
        }
}

void BM_BareLoop(benchmark::State& bench) {
    const auto n = static_cast<std::size_t>(bench.range(0));
    Cloud c(n);
    for (auto _ : bench) {
        for (std::size_t i = 0; i + 256 <= n; i += 256)
            bareLoop(n, c.x.data(), c.y.data(), c.z.data(), 256, &c.x[i], &c.y[i], &c.z[i], &c.ax[i], &c.ay[i],
                     &c.az[i], 0.01f);
        benchmark::ClobberMemory();
    }
    bench.SetItemsProcessed(bench.iterations() * static_cast<std::int64_t>(n * n));
}
BENCHMARK(BM_BareLoop)->Arg(8192)->UseRealTime()->Unit(benchmark::kMillisecond);

void BM_Pairs(benchmark::State& bench) {
    const auto n = static_cast<std::size_t>(bench.range(0));
    const tbb::global_control threads(tbb::global_control::max_allowed_parallelism,
                                      static_cast<std::size_t>(bench.range(1)));
    Cloud c(n);
    for (auto _ : bench)
        parallel::forEachBlock(n, 256, [&](std::size_t i, std::size_t count) {
            addPull({AttractionLaw::inverseSquare, 1, 0.1f}, {c.x, c.y, c.z, c.mass},
                    {count, &c.x[i], &c.y[i], &c.z[i], &c.ax[i], &c.ay[i], &c.az[i]});
        });
    bench.SetItemsProcessed(bench.iterations() * static_cast<std::int64_t>(n * n));
}
BENCHMARK(BM_Pairs)
    ->Args({8192, 1})
    ->Args({256, 2})
    ->Args({1024, 2})
    ->Args({4096, 2})
    ->Args({16384, 2})
    ->Args({100'000, 2})
    ->ArgNames({"bodies", "threads"})
    ->UseRealTime()
    ->Unit(benchmark::kMillisecond);

/// Root mean square error of the tree's pull on every hundredth body, relative to the pull.
double errorOf(const Cloud& c, float angle) {
    const std::size_t n = c.x.size(), stride = std::max<std::size_t>(n / 1000, 1);
    Cloud tree = c, exact = c;
    AttractionTree cells;
    const Attraction attraction{AttractionLaw::inverseSquare, 1, 0.1f};
    cells.build(c.x, c.y, c.z);
    cells.pull(attraction, angle, FarBodies::centreOfMass, tree.ax, tree.ay, tree.az);
    double difference = 0, size = 0;
    for (std::size_t i = 0; i < n; i += stride) {
        float x = 0, y = 0, z = 0;
        addPull(attraction, {c.x, c.y, c.z, c.mass}, {1, &c.x[i], &c.y[i], &c.z[i], &x, &y, &z});
        const glm::dvec3 e(x, y, z), t(tree.ax[i], tree.ay[i], tree.az[i]);
        difference += glm::dot(e - t, e - t);
        size += glm::dot(e, e);
    }
    return std::sqrt(difference / size);
}

void BM_Tree(benchmark::State& bench) {
    const auto n = static_cast<std::size_t>(bench.range(0));
    const tbb::global_control threads(tbb::global_control::max_allowed_parallelism,
                                      static_cast<std::size_t>(bench.range(1)));
    const float angle = static_cast<float>(bench.range(2)) / 100;
    Cloud c(n);
    AttractionTree tree;
    for (auto _ : bench) {
        tree.build(c.x, c.y, c.z);
        tree.pull({AttractionLaw::inverseSquare, 1, 0.1f}, angle, FarBodies::centreOfMass, c.ax, c.ay, c.az);
    }
    bench.counters["relative_error"] = errorOf(c, angle);
    bench.counters["pairs_per_body"] =
        static_cast<double>(tree.pairs(angle, FarBodies::centreOfMass)) / static_cast<double>(n);
}
void treeArguments(benchmark::internal::Benchmark* bench) {
    for (const std::int64_t angle : {40, 60, 80, 100, 120}) bench->Args({100'000, 2, angle});
    for (const std::int64_t bodies : {256, 1024, 4096, 16384}) bench->Args({bodies, 2, 80});
    bench->ArgNames({"bodies", "threads", "hundredths"})->UseRealTime()->Unit(benchmark::kMillisecond);
}
BENCHMARK(BM_Tree)->Apply(treeArguments);

// --- Structured particles and flocks.

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
