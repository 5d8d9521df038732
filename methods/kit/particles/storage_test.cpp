// Tests that particles do not depend on how they are stored: the variants that the experiment compares, and the choice
// of a system.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <numeric>
#include <set>
#include <string>
#include <unordered_map>
#include <vector>

#include "methods/contract/errors.h"
#include "methods/kit/maths/philox.h"
#include "methods/kit/particles/part_toml.h"
#include "methods/kit/particles/particle_store.h"
#include "methods/kit/particles/storage_experiment.h"
#include "methods/kit/particles/test_world.h"

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
        EXPECT_EQ((history<Keyed<std::unordered_map<std::uint64_t, Attributes>>>(seed)), expected);
        EXPECT_EQ((history<Keyed<std::map<std::uint64_t, Attributes>>>(seed)), expected);
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
        if (finding.quantity == "bytes_list_over_list") {
            EXPECT_EQ(finding.value, 1);
        }
    }
    EXPECT_EQ(names.size(), 35u);
}

}  // namespace
}  // namespace dustbench::particles::storage

namespace dustbench::particles {
namespace {

/// Particles that die by age and at the ground, in waves.
std::string waves(const std::string& storage) {
    return (storage.empty() ? "" : "storage = \"" + storage + "\"\n") + R"(
emission = { part = "bursts", count = 400, duration_seconds = 0.2, interval_seconds = 0.7 }
position = { part = "sphere", at = "place", place = [0, 2, 0], radius_metres = 0.5 }
velocity = { part = "random", speed = 3, variation = 2 }
colour = { part = "linear", start = [1, 0.5, 0.2], end = [0, 0.1, 0.4], opacity_start = 0.8, opacity_end = 0 }
size = { part = "random", average_metres = 0.1, variation_metres = 0.05 }
life = [ { part = "lifetime", average_seconds = 0.8, variation_seconds = 0.5 } ]
force = [ { part = "gravity", acceleration = 9.8 }, { part = "ground" } ]
)";
}

/// Every attribute of every particle, in the order of birth.
std::vector<std::vector<float>> sorted(const Puffs& p) {
    std::vector<std::size_t> order(p.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::ranges::sort(order, {}, [&](std::size_t i) { return p.serial[i]; });
    std::vector<std::vector<float>> rows;
    for (const std::size_t i : order) {
        const glm::vec3 colour = p.colour(i);
        rows.push_back({static_cast<float>(p.serial[i]), p.x[i], p.y[i], p.z[i], p.velocityX[i], p.velocityY[i],
                        p.velocityZ[i], p.age[i], p.lifetime[i], p.radius[i], p.opacity[i], colour.r, colour.g,
                        colour.b});
    }
    return rows;
}

std::size_t bytesOfNodes(const ParticleSystem& system) {
    std::size_t sum = 0;
    for (const MemoryUse& use : system.memory())
        if (use.structure == "particle nodes") sum += use.cpuBytes;
    return sum;
}

TEST(StorageChoice, GivesTheSameParticles) {
    const auto scene = test::sceneWithCar();
    auto array = test::systemFrom(waves("array")), list = test::systemFrom(waves("list")),
         pool = test::systemFrom(waves("pool"));
    std::size_t most = 0, least = 1000;
    for (int step = 0; step < 180; ++step) {
        for (ParticleSystem* system : {&array, &list, &pool}) test::advance(*system, scene, 1);
        most = std::max(most, array.store().size());
        if (step > 30) least = std::min(least, array.store().size());
        ASSERT_EQ(sorted(list.store()), sorted(array.store())) << step;
        ASSERT_EQ(list.stateHash(), pool.stateHash()) << step;
        // A list in the order of birth.
        const Puffs puffs = list.store();
        ASSERT_TRUE(std::ranges::is_sorted(puffs.serial)) << step;
        ASSERT_EQ(bytesOfNodes(list), puffs.size() * LinkedParticles::bytesPerParticle()) << step;
        ASSERT_EQ(bytesOfNodes(pool), most * LinkedParticles::bytesPerParticle()) << step;
        ASSERT_EQ(bytesOfNodes(array), 0u);
    }
    EXPECT_GT(most, 300u);
    EXPECT_LT(least, most / 2) << "the pool was never used";
}

TEST(StorageChoice, ChangesWhileRunning) {
    const auto scene = test::sceneWithCar();
    auto changing = test::systemFrom(waves("array")), array = test::systemFrom(waves("array"));
    for (const Storage storage : {Storage::list, Storage::array, Storage::pool, Storage::list, Storage::array}) {
        changing.parts().setStorage(storage);
        for (int step = 0; step < 20; ++step)
            for (ParticleSystem* system : {&changing, &array}) test::advance(*system, scene, 1);
        EXPECT_EQ(sorted(changing.store()), sorted(array.store())) << storages.wordOf(storage);
        EXPECT_EQ(bytesOfNodes(changing) > 0, storage != Storage::array);
    }
}

TEST(StorageChoice, SurvivesSavingAndLoading) {
    for (const auto& [word, storage] : storages.all()) {
        auto system = test::systemFrom(waves(std::string(word)));
        EXPECT_EQ(system.parts().storage(), storage);
        EXPECT_EQ(test::systemFrom(system.toToml()).parts().storage(), storage);
        const std::vector<NamedPartsView> two{{"one", system.parts()}, {"two", system.parts()}};
        const auto again = systemsFromText(systemsToToml(two), "two.toml");
        ASSERT_EQ(again.size(), 2u);
        EXPECT_EQ(again[1].parts->storage(), storage);
    }
    EXPECT_EQ(test::systemFrom(waves("")).parts().storage(), Storage::array);
    try {
        (void)test::systemFrom(waves("tree"));
        ADD_FAILURE();
    } catch (const InputError& error) {
        EXPECT_THAT(error.what(), testing::AllOf(testing::HasSubstr("storage"), testing::HasSubstr("'tree'"),
                                                 testing::HasSubstr("array")));
    }
}

}  // namespace
}  // namespace dustbench::particles
