// Benchmarks scan and churn of linked list, array of structures and structure of arrays, with and without a pool of
// dead particles. Items per second are particles.
#include <benchmark/benchmark.h>

#include "methods/kit/maths/philox.h"
#include "methods/kit/particles/storage_experiment.h"

namespace dustbench::particles::storage {
namespace {

constexpr float seconds = 1.0f / 60;

template <typename Storage>
void BM_Storage(benchmark::State& bench) {
    const auto particles = static_cast<std::size_t>(bench.range(0));
    Storage storage;
    std::vector<Attributes> newborns(particles / 200);
    std::uint64_t serial = 0;
    const auto step = [&] {
        for (Attributes& newborn : newborns)
            newborn.lifetime = 200 * seconds * (0.5f + maths::uniform4(1, 1, serial++)[0]);
        storage.scan(seconds);
        storage.churn(newborns);
    };
    for (int i = 0; i < 400; ++i) step();
    for (auto _ : bench) step();
    bench.SetItemsProcessed(bench.iterations() * bench.range(0));
}
#define STORAGE(...) BENCHMARK_TEMPLATE(BM_Storage, __VA_ARGS__)->Arg(10'000)->Arg(1'000'000)
STORAGE(List<false>);
STORAGE(List<true>);
STORAGE(ArrayOfStructures<false>);
STORAGE(ArrayOfStructures<true>);
STORAGE(StructureOfArrays<false>);
STORAGE(StructureOfArrays<true>);

}  // namespace
}  // namespace dustbench::particles::storage
