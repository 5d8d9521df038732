// Benchmarks sorting pairs on the GPU by every way of counting, the CPU's radix sort, and scan, compaction, reduction.
//
// The column Time is the median of repetitions after a warm-up, by timer queries where they are true (not on llvmpipe),
// else until the GPU has finished. Keys are random again before each repetition. Every result is verified before it is
// timed. `CPU/GPU` is the time of the CPU's sort of as many depths, relative to this.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <chrono>
#include <exception>
#include <functional>
#include <map>
#include <memory>
#include <numeric>
#include <optional>
#include <random>
#include <string>
#include <vector>

#include "methods/kit/draw/depth_sort.h"
#include "methods/kit/gpu/queue_marks.h"
#include "methods/kit/gpu/sort/radix_sort.h"
#include "methods/kit/gpu/sort/scan.h"

namespace dustbench::gpu {
namespace {

using Clock = std::chrono::steady_clock;
using Words = std::vector<std::uint32_t>;

constexpr std::uint32_t capacity = 10'000'000;
constexpr std::size_t room = std::size_t{capacity} * sizeof(std::uint32_t);

double millisecondsSince(Clock::time_point begin) {
    return std::chrono::duration<double, std::milli>(Clock::now() - begin).count();
}

double medianOf(std::vector<double> values) {
    std::ranges::nth_element(values, values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2));
    return values[values.size() / 2];
}

/// The device with random keys, their numbers, and buffers to work in.
struct Workplace {
    Device device;
    Words random = randomWords();
    Buffer keys{device, "keys", std::span<const std::uint32_t>(random)};
    Buffer numbers{device, "numbers", std::span<const std::uint32_t>(ascending())};
    Buffer a{device, "a", room}, b{device, "b", room}, result{device, "result", sizeof(std::uint32_t)};
    TimerQuery query{device};
    bool trueTimers = timerQueriesAreTrue(device);

    static Workplace& one() {
        static Workplace workplace;
        return workplace;
    }

    /// Median of 25 repetitions after 10 to warm up, or on a slow device of those that fit in a second, at least 3.
    double median(const std::function<void()>& prepare, const std::function<void()>& work) {
        constexpr std::size_t repetitions = 25, warmUps = 10, minimum = 3;
        std::vector<double> milliseconds;
        const auto begin = Clock::now();
        for (std::size_t n = 0; n < warmUps + repetitions; ++n) {
            prepare();
            device.finish();
            const auto start = Clock::now();
            query.begin();
            work();
            query.end();
            device.finish();
            const double elapsed = millisecondsSince(start);
            if (n >= warmUps || millisecondsSince(begin) > 1000)
                milliseconds.push_back(trueTimers ? queried() : elapsed);
            if (milliseconds.size() >= minimum && millisecondsSince(begin) > 1000) break;
        }
        return medianOf(milliseconds);
    }

 private:
    [[nodiscard]] double queried() const {
        std::optional<double> milliseconds;
        while (!milliseconds) milliseconds = query.milliseconds();
        return *milliseconds;
    }
    static Words randomWords() {
        std::mt19937 random(1);
        Words words(capacity);
        for (std::uint32_t& word : words) word = static_cast<std::uint32_t>(random());
        return words;
    }
    static Words ascending() {
        Words words(capacity);
        std::iota(words.begin(), words.end(), 0u);
        return words;
    }
};

/// Sorts as many depths on the CPU, with all its threads.
double cpuMilliseconds(std::uint32_t count) {
    static std::map<std::uint32_t, double> known;
    if (const auto found = known.find(count); found != known.end()) return found->second;
    MemoryLedger ledger;
    draw::DepthSort sort(ledger);
    std::vector<float> depths(count);
    for (std::size_t i = 0; i < count; ++i)
        depths[i] = 5 + 60 * static_cast<float>(Workplace::one().random[i]) * 0x1p-32f;
    std::vector<double> milliseconds;
    for (int repetition = 0; repetition < 5; ++repetition) {
        const auto begin = Clock::now();
        benchmark::DoNotOptimize(sort.farToNear(draw::SortKind::radix, depths));
        milliseconds.push_back(millisecondsSince(begin));
    }
    return known[count] = medianOf(milliseconds);
}

void tell(benchmark::State& state, double milliseconds, std::uint32_t count) {
    state.SetIterationTime(milliseconds * 1e-3);
    state.SetLabel(Workplace::one().device.info().renderer);
    state.counters["elements"] = benchmark::Counter(count, benchmark::Counter::kIsIterationInvariantRate);
}

std::string nameOf(const RadixSortSettings& settings) {
    return std::string(earlierTilesChoices.wordOf(settings.earlierTiles)) + "/" +
           std::string(warpRanksChoices.wordOf(settings.warpRanks)) + "/" + std::to_string(settings.keysPerThread);
}

/// Sorted pairs are the given keys in order, with ascending numbers where keys are equal.
bool areSorted(const Words& keys, const Words& numbers, const Words& given) {
    for (std::size_t i = 0; i < keys.size(); ++i) {
        if (numbers[i] >= given.size() || given[numbers[i]] != keys[i]) return false;
        if (i > 0 && (keys[i - 1] > keys[i] || (keys[i - 1] == keys[i] && numbers[i - 1] >= numbers[i]))) return false;
    }
    return true;
}

Words read(const Buffer& buffer, std::uint32_t count) {
    Words words(count);
    buffer.read(std::span<std::uint32_t>(words));
    return words;
}

void sortPairs(benchmark::State& state, RadixSortSettings settings, std::uint32_t count) {
    Workplace& at = Workplace::one();
    if (settings.warpRanks == WarpRanks::subgroups && at.device.subgroupThreads() != 32)
        return state.SkipWithError("the device has no subgroups of 32 threads");
    static std::map<std::string, std::unique_ptr<RadixSort>> sorts;  // each way is compiled once
    std::unique_ptr<RadixSort>& sort = sorts[nameOf(settings)];
    if (!sort) try {
            sort = std::make_unique<RadixSort>(at.device, capacity, settings);
        } catch (const std::exception& error) {
            return state.SkipWithError(error.what());
        }
    const auto shuffle = [&] {
        at.a.copyFrom(at.keys, count * sizeof(std::uint32_t));
        at.b.copyFrom(at.numbers, count * sizeof(std::uint32_t));
    };
    shuffle();
    sort->sort(at.a, at.b, count);
    if (!areSorted(read(at.a, count), read(at.b, count), at.random)) return state.SkipWithError("wrong order");
    for (auto _ : state) {
        const double milliseconds = at.median(shuffle, [&] { sort->sort(at.a, at.b, count); });
        tell(state, milliseconds, count);
        state.counters["CPU/GPU"] = cpuMilliseconds(count) / milliseconds;
    }
}

void cpuSort(benchmark::State& state, std::uint32_t count) {
    for (auto _ : state) tell(state, cpuMilliseconds(count), count);
    state.SetLabel("CPU");
}

void scan(benchmark::State& state, std::uint32_t count) {
    Workplace& at = Workplace::one();
    InclusiveScan scan(at.device, count);
    scan.scan(at.keys, at.a, count);
    Words expected(at.random.begin(), at.random.begin() + count);
    std::inclusive_scan(expected.begin(), expected.end(), expected.begin());
    if (read(at.a, count) != expected) return state.SkipWithError("wrong sums");
    for (auto _ : state) tell(state, at.median([] {}, [&] { scan.scan(at.keys, at.a, count); }), count);
}

/// Keeps the odd elements, about half.
void compact(benchmark::State& state, std::uint32_t count) {
    Workplace& at = Workplace::one();
    Words flags(count);
    std::ranges::transform(at.random.begin(), at.random.begin() + count, flags.begin(),
                           [](std::uint32_t key) { return key & 1u; });
    at.b.write(std::span<const std::uint32_t>(flags));
    Compaction compaction(at.device, count);
    compaction.compact(at.keys, at.b, count, at.a, at.result);
    Words expected;
    std::copy_if(at.random.begin(), at.random.begin() + count, std::back_inserter(expected),
                 [](std::uint32_t key) { return (key & 1u) != 0; });
    if (read(at.a, static_cast<std::uint32_t>(expected.size())) != expected)
        return state.SkipWithError("wrong elements");
    for (auto _ : state)
        tell(state, at.median([] {}, [&] { compaction.compact(at.keys, at.b, count, at.a, at.result); }), count);
}

void reduce(benchmark::State& state, std::uint32_t count) {
    Workplace& at = Workplace::one();
    Reduction reduction(at.device, count, Reduce::sum, Number::uint32);
    reduction.reduce(at.keys, count, at.result);
    if (read(at.result, 1).front() != std::reduce(at.random.begin(), at.random.begin() + count))
        return state.SkipWithError("wrong sum");
    for (auto _ : state) tell(state, at.median([] {}, [&] { reduction.reduce(at.keys, count, at.result); }), count);
}

template <typename Work>
void add(const std::string& name, const Work& work) {
    for (const std::uint32_t count : {10'000u, 100'000u, 1'000'000u, 10'000'000u})
        benchmark::RegisterBenchmark((name + "/" + std::to_string(count)).c_str(),
                                     [=](benchmark::State& state) { work(state, count); })
            ->Iterations(1)
            ->UseManualTime()
            ->Unit(benchmark::kMillisecond);
}

const bool added = [] {
    for (const EarlierTiles earlier : {EarlierTiles::lookBack, EarlierTiles::scan})
        for (const WarpRanks ranks : {WarpRanks::subgroups, WarpRanks::shared})
            for (const std::uint32_t keysPerThread : {8u, 16u, 24u}) {
                const RadixSortSettings settings{earlier, ranks, keysPerThread};
                add("sort/" + nameOf(settings),
                    [settings](benchmark::State& state, std::uint32_t count) { sortPairs(state, settings, count); });
            }
    add("cpu_sort", cpuSort);
    add("scan", scan);
    add("compact", compact);
    add("reduce", reduce);
    return true;
}();

}  // namespace
}  // namespace dustbench::gpu
