// Benchmarks far-to-near order of (depth, index): this sort and common alternatives, on the same points in the same
// run.
#include "methods/kit/draw/depth_sort.h"

#include <benchmark/benchmark.h>
#include <oneapi/tbb/parallel_sort.h>
#include <oneapi/tbb/task_arena.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <random>
#include <vector>

namespace dustbench::draw {
namespace {

struct Points {
    std::vector<float> x, y, z;

    [[nodiscard]] float squaredDistance(std::size_t i) const { return x[i] * x[i] + y[i] * y[i] + z[i] * z[i]; }
};

/// A 60 m trail of dust in front of an eye at the origin.
const Points& trail(std::size_t count) {
    static std::array<Points, 8> made;
    Points& points = made[static_cast<std::size_t>(std::log10(static_cast<double>(count)))];
    if (points.x.size() != count) {
        std::mt19937 random(1);
        std::uniform_real_distribution<float> along(-65, -5);
        std::normal_distribution<float> across(0, 2);
        points = {};
        for (std::size_t i = 0; i < count; ++i) {
            points.x.push_back(across(random));
            points.y.push_back(across(random));
            points.z.push_back(along(random));
        }
    }
    return points;
}

struct DepthIndex {
    float depth;
    std::uint32_t index;
};

bool farther(const DepthIndex& a, const DepthIndex& b) {
    return a.depth > b.depth;
}

std::vector<DepthIndex>& keyed(const Points& points) {
    static std::vector<DepthIndex> elements;
    elements.resize(points.x.size());
    for (std::size_t i = 0; i < elements.size(); ++i)
        elements[i] = {points.squaredDistance(i), static_cast<std::uint32_t>(i)};
    return elements;
}

/// A straightforward radix sort: stores keys first, computes histograms in one pass, then scatters three times.
void plainRadix(const Points& points, std::vector<DepthIndex>& a, std::vector<DepthIndex>& b) {
    std::array<std::array<std::uint32_t, 2048>, 3> counts{};
    const std::size_t count = points.x.size();
    const auto key = [](float depth) {
        std::uint32_t bits;
        std::memcpy(&bits, &depth, sizeof bits);
        return ~bits;
    };
    a.resize(count);
    b.resize(count);
    for (std::size_t i = 0; i < count; ++i) {
        a[i] = {points.squaredDistance(i), static_cast<std::uint32_t>(i)};
        const std::uint32_t bits = key(a[i].depth);
        ++counts[0][bits & 2047];
        ++counts[1][bits >> 11 & 2047];
        ++counts[2][bits >> 22];
    }
    for (unsigned digit = 0; digit < 3; ++digit) {
        std::uint32_t place = 0;
        for (std::uint32_t& bucket : counts[digit]) place += std::exchange(bucket, place);
        for (const DepthIndex& element : a) b[counts[digit][key(element.depth) >> 11 * digit & 2047]++] = element;
        std::swap(a, b);
    }
}

void run(benchmark::State& state, const auto& work) {
    const Points& points = trail(static_cast<std::size_t>(state.range(0)));
    for (auto _ : state) work(points);
    state.SetItemsProcessed(state.iterations() * state.range(0));
}

void standardSort(benchmark::State& state) {
    run(state, [](const Points& points) {
        auto& elements = keyed(points);
        std::sort(elements.begin(), elements.end(), farther);
        benchmark::ClobberMemory();
    });
}

void parallelSort(benchmark::State& state) {
    run(state, [](const Points& points) {
        auto& elements = keyed(points);
        tbb::parallel_sort(elements.begin(), elements.end(), farther);
        benchmark::ClobberMemory();
    });
}

void plainRadixSort(benchmark::State& state) {
    std::vector<DepthIndex> a, b;
    run(state, [&](const Points& points) {
        plainRadix(points, a, b);
        benchmark::ClobberMemory();
    });
}

void depthSort(benchmark::State& state, SortKind kind, int threads) {
    MemoryLedger ledger;
    DepthSort sort(ledger);
    tbb::task_arena arena(threads);
    run(state, [&](const Points& points) {
        arena.execute([&] {
            benchmark::DoNotOptimize(sort.farToNear(kind, PointColumns{points.x, points.y, points.z}, glm::vec3(0)));
        });
    });
}

void sizes(benchmark::internal::Benchmark* benchmark) {
    benchmark->Arg(10'000)->Arg(100'000)->Arg(1'000'000)->Unit(benchmark::kMillisecond)->UseRealTime();
}

BENCHMARK(standardSort)->Apply(sizes);
BENCHMARK(parallelSort)->Apply(sizes);
BENCHMARK(plainRadixSort)->Apply(sizes);
BENCHMARK_CAPTURE(depthSort, radix_one_thread, SortKind::radix, 1)->Apply(sizes);
BENCHMARK_CAPTURE(depthSort, radix_two_threads, SortKind::radix, 2)->Apply(sizes);
BENCHMARK_CAPTURE(depthSort, quicksort, SortKind::quicksort, 1)->Apply(sizes);

}  // namespace
}  // namespace dustbench::draw
