// Benchmarks reliefs against baselines: the march against a mesh of the same detail, ageing against a bare loop of
// writes, the particles against the shared dust's update.
//
// Both sides run alternately. `ms` and `other_ms` are medians of the processor time of all threads, so that they can be
// compared while other programs run; OpenGL without a GPU draws on threads of this program. `ratio` is the median of
// the pairs' quotients other_ms/ms: above 1, ours is faster.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <cmath>
#include <ctime>
#include <random>
#include <vector>

#include "methods/kit/particles/part.h"
#include "methods/kit/particles/particle_system.h"
#include "methods/relief/particles/relief_particles.h"
#include "methods/relief/relief_studio.h"
#include "source_folder.h"

namespace dustbench::relief {
namespace {

gpu::Device& device() {
    static gpu::Device one;
    return one;
}

template <typename Work>
double processorMilliseconds(const Work& work) {
    const std::clock_t begin = std::clock();
    work();
    return 1e3 * static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC;
}

double medianOf(std::vector<double> values) {
    std::ranges::nth_element(values, values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2));
    return values[values.size() / 2];
}

/// Runs both alternately; `prepare` is called before each and not timed.
template <typename Prepare, typename Ours, typename Other>
void inTurns(benchmark::State& bench, const Prepare& prepare, const Ours& ours, const Other& other) {
    std::vector<double> mine, theirs, ratios;
    for (auto _ : bench) {
        prepare();
        mine.push_back(processorMilliseconds(ours));
        prepare();
        theirs.push_back(processorMilliseconds(other));
        ratios.push_back(theirs.back() / mine.back());
    }
    bench.counters["ms"] = medianOf(mine);
    bench.counters["other_ms"] = medianOf(theirs);
    bench.counters["ratio"] = medianOf(ratios);
}

/// Hills of all sizes, so that no part is easy for a march or a mesh.
scene::Panel hills(int side) {
    auto relief = std::make_shared<scene::Relief>();
    relief->columns = relief->rows = side;
    std::mt19937 random(3);
    std::uniform_real_distribution<float> any(0, 1);
    const float turn = 6.2831853f / static_cast<float>(side);
    for (int row = 0; row < side; ++row)
        for (int column = 0; column < side; ++column) {
            const auto u = static_cast<float>(column) * turn, v = static_cast<float>(row) * turn;
            const float coarse = std::sin(7 * u) * std::cos(9 * v), fine = std::sin(61 * u + 3 * std::sin(53 * v));
            relief->depth.push_back(0.5f + 0.3f * coarse + 0.1f * fine + 0.05f * any(random));
            relief->colour.emplace_back(0.4f);
        }
    scene::Panel panel;
    panel.sizeMetres = {4, 3};
    panel.depthMetres = 0.05;
    panel.relief = relief;
    return panel;
}

void BM_MarchAgainstMesh(benchmark::State& bench) {
    const scene::Panel panel = hills(static_cast<int>(bench.range(0)));
    const scene::Scene scene;
    const scene::View view = viewOf(panel, static_cast<double>(bench.range(1)), 800, 600);
    ReliefStudio march(device(), scene, panel, {.march = March::safe, .shadow = false}, view);
    ReliefStudio mesh(device(), scene, panel, {.march = March::mesh, .shadow = false}, view);
    const auto drawn = [](ReliefStudio& studio) {
        return [&studio] {
            studio.draw();
            device().finish();
        };
    };
    drawn(march)();
    drawn(mesh)();
    inTurns(
        bench, [] { device().finish(); }, drawn(march), drawn(mesh));
}
BENCHMARK(BM_MarchAgainstMesh)
    ->ArgNames({"side", "degrees"})
    ->ArgsProduct({{64, 128, 256, 512, 1024, 2048}, {0}})
    ->ArgsProduct({{1024}, {60, 80}})
    ->Unit(benchmark::kMillisecond);

/// Random hits, of one texel or of a pit, with the texels and amounts that each writes.
struct Hits {
    Hits(const WornSurface& surface, int count, float radius) {
        std::mt19937 random(5);
        const auto side = static_cast<float>(surface.depths().columns());
        std::uniform_real_distribution<float> place(5, side - 6);
        for (int n = 0; n < count; ++n) {
            const Impact impact{place(random), place(random), radius, DepthMap::bottom / 1000};
            impacts.push_back(impact);
            const int reach = static_cast<int>(radius) + 1;
            const int u = static_cast<int>(std::lround(impact.u)), v = static_cast<int>(std::lround(impact.v));
            for (int row = v - reach; row <= v + reach; ++row)
                for (int column = u - reach; column <= u + reach; ++column)
                    if (const std::uint32_t change = changeAt(impact, column, row); change > 0)
                        writes.push_back({static_cast<std::uint32_t>(surface.depths().texel(column, row)), change});
        }
    }

    struct Write {
        std::uint32_t texel, change;
    };
    std::vector<Impact> impacts;
    std::vector<Write> writes;
};

void BM_ScatterAgainstBareWrites(benchmark::State& bench) {
    const scene::Panel panel = hills(static_cast<int>(bench.range(0)));
    MemoryLedger ledger;
    WornSurface surface(*panel.relief, ledger);
    const Hits hits(surface, 100'000, static_cast<float>(bench.range(1)));
    std::vector<std::uint32_t> texels(surface.depths().size());
    inTurns(
        bench, [&] { surface.takeOff(); }, [&] { surface.scatter(hits.impacts); },
        [&] {
            for (const Hits::Write& write : hits.writes) texels[write.texel] += write.change;
            benchmark::DoNotOptimize(texels.data());
        });
    bench.counters["writes"] = static_cast<double>(hits.writes.size());
}
BENCHMARK(BM_ScatterAgainstBareWrites)
    ->ArgNames({"side", "radius"})
    ->ArgsProduct({{256, 1024, 4096}, {0, 2, 4}})
    ->Unit(benchmark::kMillisecond);

/// A million particles within a relief, moving `range(0)` tenths of a texel per step: between the face and the highest
/// point (`near` = 0), or halfway to the surface below them (1), where some hit. Those that end are replaced every 40
/// steps.
void BM_ParticlesAgainstSharedDust(benchmark::State& bench) {
    constexpr std::int64_t count = 1'000'000;
    constexpr float dt = 1.0f / 60;
    scene::Panel panel = hills(1024);
    panel.sizeMetres = {1024, 1024};  // a texel a metre
    panel.depthMetres = 1000;
    const float speed = static_cast<float>(bench.range(0)) / 10 / dt;
    MemoryLedger ledger;
    const DepthMap surface(*panel.relief, ledger);
    const DepthPyramid pyramid(surface, ledger);
    ReliefParticles grains(panel, ledger);
    const auto refill = [&] {
        grains = ReliefParticles(panel, ledger);
        std::mt19937 random(7);
        std::uniform_real_distribution<float> any(-1, 1);
        for (std::int64_t n = 0; n < count; ++n) {
            const float angle = 3.1415927f * any(random), x = 400 * any(random), y = 400 * any(random);
            const glm::dvec3 texels = grains.texels().toTexels({x, y, 0});
            const float z =
                bench.range(1) == 0 ? -1.0f : -500 * static_cast<float>(surface.depthAt(texels.x, texels.y));
            grains.add({{x, y, z}, {speed * std::cos(angle), speed * std::sin(angle), -0.01f}}, {},
                       static_cast<std::uint64_t>(n));
        }
    };
    refill();
    auto dust = particles::ParticleSystem::load(DUSTBENCH_SOURCE_DIR "/data/particles/wheel_dust.toml", 1);
    scene::Scene scene;
    scene.vehicle.emplace();
    scene::SceneState state;
    state.vehicle.speed = 20;
    const auto advance = [&] {
        state.timeSeconds += static_cast<double>(dt);
        dust.update({scene, state, static_cast<double>(dt), count});
    };
    for (int step = 0; step < 320; ++step) advance();
    int step = 0;
    inTurns(
        bench,
        [&] {
            if (++step % 40 == 0) refill();
        },
        [&] {
            grains.step(surface,
                        {.gravity = {0, 0, 0}, .stepSeconds = dt, .maximumAgeSteps = 1e6f, .pyramid = &pyramid});
        },
        advance);
    bench.counters["grains"] = static_cast<double>(grains.size());
    bench.counters["dust"] = static_cast<double>(dust.store().size());
}
BENCHMARK(BM_ParticlesAgainstSharedDust)
    ->ArgNames({"tenths", "near"})
    ->ArgsProduct({{1, 10, 80}, {0, 1}})
    ->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace dustbench::relief
