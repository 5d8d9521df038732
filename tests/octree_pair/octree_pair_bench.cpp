// Cost of inserting a million particles into voxels: both octree methods, both layouts, depth 8, 4 levels, from the
// particles' columns to nodes and the list of voxels. Three clouds, in the order of emission and shuffled.
//
// Also reports bytes per node (including inner nodes), bytes of the list per voxel, and total bytes per particle.
#include <benchmark/benchmark.h>

#include <cmath>
#include <memory>
#include <numeric>
#include <random>
#include <vector>

#include "methods/kit/octree/brick_builder.h"
#include "methods/kit/particles/particle_store.h"
#include "methods/octree_recursive/octree_recursive.h"
#include "methods/octree_search/octree_search.h"
#include "tests/octree_pair/node_walk.h"

namespace dustbench::octree_pair {
namespace {

constexpr std::size_t particleCount = 1'000'000;

enum class Cloud { gaussian8, gaussian20, trail };

/// The oldest particle first, as from an emitter.
void fill(particles::ParticleStore& store, Cloud cloud, bool shuffled) {
    std::mt19937_64 random(1);
    std::normal_distribution<float> normal;
    std::uniform_real_distribution<float> unit(0, 1);
    std::vector<std::size_t> places(particleCount);
    std::iota(places.begin(), places.end(), std::size_t{0});
    if (shuffled) std::ranges::shuffle(places, random);
    store.resize(particleCount);
    for (std::size_t k = 0; k < particleCount; ++k) {
        const std::size_t i = places[k];
        const float life = 1 - static_cast<float>(k) / static_cast<float>(particleCount);
        store.serial[i] = k;
        store.lifetime[i] = 4;
        store.age[i] = 4 * life;
        store.opacity[i] = 0.3f * (1 - life) + 0.01f * unit(random);
        store.radius[i] = 0.2f + life;
        if (cloud == Cloud::trail) {
            // 40 m of trail behind the four wheels of a car, spreading with age.
            const float width = 0.2f + 1.5f * life;
            store.x[i] = 30 - 40 * life - (k % 4 < 2 ? 0.0f : 2.5f) + width * normal(random);
            store.y[i] = 0.7f * std::abs(width * normal(random));
            store.z[i] = (k % 2 == 0 ? 0.8f : -0.8f) + width * normal(random);
        } else {
            const float deviation = cloud == Cloud::gaussian8 ? 8.0f : 20.0f;
            store.x[i] = deviation * normal(random);
            store.y[i] = deviation * normal(random);
            store.z[i] = deviation * normal(random);
        }
    }
}

template <typename Builder>
void build(benchmark::State& state) {
    MemoryLedger ledger, stores;
    particles::ParticleStore store(stores);
    fill(store, static_cast<Cloud>(state.range(0)), state.range(1) != 0);
    octree::Lattice lattice;
    lattice.origin = glm::dvec3(-64);
    Builder builder(ledger);
    octree::Octree tree(ledger);
    for (auto _ : state) benchmark::DoNotOptimize(builder.build(store, lattice, octree::OctreeSettings{}, tree));
    state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(particleCount));
    const auto voxels = static_cast<double>(tree.voxels().size());
    state.counters["voxels"] = voxels;
    state.counters["B/node"] = static_cast<double>(tree.blocks().size_bytes()) / static_cast<double>(countNodes(tree));
    state.counters["B/voxel"] = static_cast<double>(tree.blocks().size_bytes() + tree.voxels().size_bytes()) / voxels;
    state.counters["B/particle"] = static_cast<double>(ledger.totalBytes()) / static_cast<double>(particleCount);
}

void clouds(benchmark::internal::Benchmark* bench) {
    bench->ArgNames({"cloud", "shuffled"})->ArgsProduct({{0, 1, 2}, {0, 1}});
    bench->Unit(benchmark::kMillisecond)->UseRealTime()->MinTime(0.5);
}

BENCHMARK(build<octree_search::InsertionBuilder>)->Name("search, faithful")->Apply(clouds);
BENCHMARK(build<octree_recursive::ListBuilder>)->Name("recursive, faithful")->Apply(clouds);
BENCHMARK(build<octree::BrickBuilder<octree_search::GridReducer>>)->Name("search, morton")->Apply(clouds);
BENCHMARK(build<octree::BrickBuilder<octree_recursive::SortingReducer>>)->Name("recursive, morton")->Apply(clouds);

}  // namespace
}  // namespace dustbench::octree_pair
