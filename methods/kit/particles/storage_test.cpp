// Tests that all storages keep the same particles, so that their times can be compared.
#include <gtest/gtest.h>

#include <set>
#include <string>
#include <vector>

#include "methods/kit/maths/philox.h"
#include "methods/kit/particles/storage_experiment.h"
#include "methods/kit/particles/storage_variants.h"

namespace dustbench::particles::storage {
namespace {

/// Sums of ages over 100 steps, in which births increase and stop.
template <typename Storage>
std::vector<double> history(std::uint64_t seed) {
    Storage storage;
    std::vector<double> sums;
    std::uint64_t serial = 0;
    for (int step = 0; step < 100; ++step) {
        storage.scan(0.125f);
        std::vector<Attributes> newborns(step % 20 < 12 ? static_cast<std::size_t>(step) : 0);
        for (Attributes& newborn : newborns) newborn.lifetime = 0.5f + 2 * maths::uniform4(seed, 1, serial++)[0];
        storage.churn(newborns);
        sums.push_back(storage.sumOfAges());
    }
    return sums;
}

TEST(Storage, AllVariantsKeepTheSameParticles) {
    for (const std::uint64_t seed : {1, 2, 3}) {
        const auto expected = history<List<false>>(seed);  // ages are multiples of 1/8: sums are exact in any order
        EXPECT_GT(expected.at(50), 10);
        EXPECT_EQ(history<List<true>>(seed), expected);
        EXPECT_EQ(history<ArrayOfStructures<false>>(seed), expected);
        EXPECT_EQ(history<ArrayOfStructures<true>>(seed), expected);
        EXPECT_EQ(history<ErasedArray>(seed), expected);
        EXPECT_EQ(history<StructureOfArrays<false>>(seed), expected);
        EXPECT_EQ(history<StructureOfArrays<true>>(seed), expected);
    }
}

TEST(StorageExperiment, HasEveryFindingOnce) {
    std::set<std::string> names;
    for (const Finding& finding : measureStorage(1, 2000, 3)) {
        EXPECT_TRUE(names.insert(finding.quantity).second) << finding.quantity;
        EXPECT_GT(finding.low, 0) << finding.quantity;
        EXPECT_LE(finding.low, finding.value);
        EXPECT_LE(finding.value, finding.high);
    }
    EXPECT_EQ(names.size(), 30u);
}

}  // namespace
}  // namespace dustbench::particles::storage
