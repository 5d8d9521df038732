// Benchmarks a step of particles with look-up, interpolation and one force, on grids of 16³ to 256³.
#include "methods/voxel_shape/particles/shape_system.h"

#include <benchmark/benchmark.h>

#include <memory>

#include "methods/voxel_shape/voxels/surface_voxels.h"
#include "methods/voxel_shape/voxels/test_meshes.h"

namespace dustbench::voxel_shape {
namespace {

constexpr float dt = 1.0f / 60;

MemoryLedger& ledger() {
    static MemoryLedger one;
    return one;
}

/// Returns a block of particles: every voxel of a cube is active and has a force.
ShapeSystem cubeOf(int resolution, std::uint32_t particles, Force force) {
    MarkedVoxels marked(Lattice{glm::ivec3(resolution), glm::vec3(-1), 2.0f / static_cast<float>(resolution)});
    std::fill(marked.marked.begin(), marked.marked.end(), std::uint8_t{1});
    Voxel voxel;
    voxel.interpolationSeconds = 0.2f;
    // The acceleration is weak enough to keep the particles inside for thousands of steps.
    voxel.setForce(force, {0, force == Force::linear ? 1e-3f : 2.0f, 0}, force == Force::linear ? 0.0f : 0.02f);
    ShapeSystem system(ledger(), marked, voxel, 1);
    system.grid().shareOut(particles);
    return system;
}

void step(benchmark::State& state, Force force) {
    const auto particles = static_cast<std::uint32_t>(state.range(1));
    ShapeSystem system = cubeOf(static_cast<int>(state.range(0)), particles, force);
    Motion motion;
    motion.birthSpeed = 0.1f;
    for (int i = 0; i < 3; ++i) system.step({}, motion, dt);
    for (auto _ : state) system.step({}, motion, dt);
    state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(system.particles().size()));
    state.counters["MiB_voxels"] = static_cast<double>(system.grid().voxels().size_bytes()) / (1 << 20);
}

/// A step without births: the paper's update.
void update(benchmark::State& state, Force force) {
    const auto particles = static_cast<std::uint32_t>(state.range(1));
    ShapeSystem system = cubeOf(static_cast<int>(state.range(0)), particles, force);
    Motion motion;
    motion.birthSpeed = 0.1f;
    for (int i = 0; i < 3; ++i) system.step({}, motion, dt);
    for (auto _ : state) system.live(motion, dt);
    state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(system.particles().size()));
}

#define SIZES                                                \
    ->ArgNames({"side", "particles"})                        \
        ->ArgsProduct({{16, 32, 64, 128, 256}, {1'000'000}}) \
        ->Args({64, 40'000})                                 \
        ->UseRealTime()                                      \
        ->Unit(benchmark::kMillisecond)
BENCHMARK_CAPTURE(update, linear, Force::linear) SIZES;
BENCHMARK_CAPTURE(update, helix, Force::helix) SIZES;
BENCHMARK_CAPTURE(step, linear, Force::linear) SIZES;

}  // namespace
}  // namespace dustbench::voxel_shape
