// Benchmarks the construction of octrees on the GPU: a trail of 40 m behind the wheels of a car in a world of 128 m,
// depth 9, 4 levels.
//
// The column Time is the median of repetitions after a warm-up, by timer queries where they are true (not on llvmpipe),
// else until the GPU has finished; the counters are medians of its steps, each timed alone: keys (world and cells),
// sort, levels (runs of particles, and their reduction) and list, in ms. The voxels are verified before they are timed.
#include "methods/kit/octree/gpu/gpu_octree.h"

#include <benchmark/benchmark.h>

#include <algorithm>
#include <chrono>
#include <map>
#include <optional>
#include <random>
#include <string>
#include <string_view>
#include <vector>

#include "methods/kit/gpu/queue_marks.h"
#include "methods/kit/octree/gpu/gpu_octree_dust.h"
#include "methods/kit/octree/map_builder_test_tree.h"
#include "methods/kit/particles/particle_store.h"

namespace dustbench::octree {
namespace {

using Clock = std::chrono::steady_clock;

double medianMs(std::vector<double> values) {
    if (values.empty()) return 0;
    std::ranges::nth_element(values, values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2));
    return values[values.size() / 2];
}

/// Times sections of GPU work, and the steps that it hears of.
class SectionTimer final : public StageListener {
 public:
    explicit SectionTimer(gpu::Device& device)
        : device_(device), query_(device), trueTimers_(gpu::timerQueriesAreTrue(device)) {}

    void start() {
        device_.finish();
        begin_ = Clock::now();
        query_.begin();
    }
    double stop() {
        query_.end();
        device_.finish();
        const double elapsed = std::chrono::duration<double, std::milli>(Clock::now() - begin_).count();
        if (!trueTimers_) return elapsed;
        std::optional<double> milliseconds;
        while (!milliseconds) milliseconds = query_.milliseconds();
        return *milliseconds;
    }

    void begin(Stage) override {}
    void end(Stage) override {}
    void beginDetail(std::string_view) override { start(); }
    void endDetail(std::string_view name) override { steps[name].push_back(stop()); }

    std::map<std::string_view, std::vector<double>> steps;

 private:
    gpu::Device& device_;
    gpu::TimerQuery query_;
    bool trueTimers_;
    Clock::time_point begin_;
};

/// The oldest particle first, as from emitters at four wheels.
void fillTrail(particles::ParticleStore& store, std::size_t count) {
    std::mt19937_64 random(1);
    std::normal_distribution<float> normal;
    std::uniform_real_distribution<float> unit(0, 1);
    store.resize(count);
    for (std::size_t i = 0; i < count; ++i) {
        const float life = 1 - static_cast<float>(i) / static_cast<float>(count), width = 0.2f + 1.5f * life;
        store.serial[i] = i;
        store.lifetime[i] = 4;
        store.age[i] = 4 * life;
        store.opacity[i] = 0.3f * (1 - life) + 0.01f * unit(random);
        store.radius[i] = 0.2f + life;
        store.x[i] = 30 - 40 * life - (i % 4 < 2 ? 0.0f : 2.5f) + width * normal(random);
        store.y[i] = 0.7f * std::abs(width * normal(random));
        store.z[i] = (i % 2 == 0 ? 0.8f : -0.8f) + width * normal(random);
    }
}

/// Whether the voxels are those of the CPU's simplest builder.
bool areRight(const GpuOctree& octree, const Puffs& dust, const DustSettings& settings) {
    MemoryLedger ledger;
    Octree tree(ledger);
    const Lattice lattice = octree.readNumbers().lattice;
    OctreeSettings ofTree = settings.tree;
    ofTree.depth = lattice.depth;
    MapBuilder().build(dust, lattice, ofTree, tree);
    const std::vector<GpuVoxel> voxels = octree.readVoxels();
    return std::ranges::equal(voxels, tree.voxels(), [](const GpuVoxel& a, const CellEntry& b) {
        return a.place == b.place() && a.particle == b.index();
    });
}

void buildOctree(benchmark::State& state, OpacityPolicy policy, std::size_t count) {
    constexpr int repetitions = 25, warmUps = 10, least = 3;
    static gpu::Device device;
    MemoryLedger ledger;
    particles::ParticleStore store(ledger);
    fillTrail(store, count);
    DustSettings settings;
    settings.tree.depth = 9;
    settings.tree.policy = policy;
    PuffUpload upload(device);
    const GpuPuffs dust = upload.upload(store);
    GpuOctree octree(device);
    SectionTimer timer(device);
    const StageClock untimed, timed(&timer);
    const glm::dvec3 vehicle(30, 0, 0);
    octree.build(dust, settings, vehicle, true, untimed);
    if (!areRight(octree, store, settings)) return state.SkipWithError("wrong voxels");
    for (auto _ : state) {
        std::vector<double> whole;
        const auto begin = Clock::now();
        const auto isLate = [&] { return Clock::now() - begin > std::chrono::seconds(2); };
        for (int n = 0; n < warmUps + repetitions; ++n) {
            timer.start();
            octree.build(dust, settings, vehicle, false, untimed);
            const double milliseconds = timer.stop();
            if (n >= warmUps || isLate()) whole.push_back(milliseconds);
            if (n < warmUps) timer.steps.clear();
            octree.build(dust, settings, vehicle, false, timed);
            if (isLate() && whole.size() >= least) break;
        }
        state.SetIterationTime(medianMs(whole) * 1e-3);
    }
    for (const auto& [step, name] : {std::pair("keys", "keys"), std::pair("order", "sort"), std::pair("runs", "levels"),
                                     std::pair("list", "list")})
        state.counters[name] = medianMs(timer.steps[step]);
    const GpuOctreeNumbers numbers = octree.readNumbers();
    state.counters["voxels"] = numbers.voxels;
    state.counters["MB"] = static_cast<double>(octree.bytes()) / 1e6;
    state.SetLabel(device.info().renderer);
}

const bool added = [] {
    for (const OpacityPolicy policy : {OpacityPolicy::max, OpacityPolicy::accumulate})
        for (const std::size_t count : {10'000u, 100'000u, 1'000'000u})
            benchmark::RegisterBenchmark(
                ("octree/" + std::string(opacityPolicies.wordOf(policy)) + "/" + std::to_string(count)).c_str(),
                [=](benchmark::State& state) { buildOctree(state, policy, count); })
                ->Iterations(1)
                ->UseManualTime()
                ->Unit(benchmark::kMillisecond);
    return true;
}();

}  // namespace
}  // namespace dustbench::octree
