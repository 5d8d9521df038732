// Both octree methods give the same, correct voxels in all layouts.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <oneapi/tbb/global_control.h>
#include <oneapi/tbb/task_arena.h>

#include <bit>
#include <functional>
#include <limits>
#include <memory>
#include <random>
#include <vector>

#include "methods/kit/octree/brick_builder.h"
#include "methods/kit/octree/octree_march.h"
#include "methods/kit/octree/plain_octree.h"
#include "methods/kit/particles/particle_store.h"
#include "methods/octree_recursive/octree_recursive.h"
#include "methods/octree_search/octree_search.h"
#include "tests/octree_pair/node_walk.h"

namespace dustbench::octree_pair {
namespace {

using octree::Lattice;
using octree::Octree;
using octree::OctreeBuilder;
using octree::OctreeSettings;
using octree::PlainOctree;
using particles::ParticleStore;

struct NamedBuilder {
    const char* name;
    std::unique_ptr<OctreeBuilder> builder;
};

std::vector<NamedBuilder> allBuilders(MemoryLedger& ledger) {
    std::vector<NamedBuilder> builders;
    builders.push_back({"search", std::make_unique<octree_search::InsertionBuilder>(ledger)});
    builders.push_back({"recursive", std::make_unique<octree_recursive::ListBuilder>(ledger)});
    builders.push_back({"search, morton", std::make_unique<octree::BrickBuilder<octree_search::GridReducer>>(ledger)});
    builders.push_back(
        {"recursive, morton", std::make_unique<octree::BrickBuilder<octree_recursive::SortingReducer>>(ledger)});
    builders.push_back({"search, paper", std::make_unique<octree_search::PaperBuilder>(ledger)});
    builders.push_back({"recursive, paper", std::make_unique<octree_recursive::PaperBuilder>(ledger)});
    return builders;
}

struct Case {
    Lattice lattice;
    OctreeSettings settings;
};

/// A random set: clustered, on cell borders, in the same place, outside; some with equal ages and opacities.
Case makeCase(std::mt19937_64& random, std::size_t count, ParticleStore& store) {
    const auto upTo = [&random](int n) { return static_cast<int>(random() % static_cast<std::uint64_t>(n)); };
    std::uniform_real_distribution<float> unit(0, 1);
    std::normal_distribution<float> normal;
    Case made;
    made.settings.depth = 4 + upTo(9);
    made.settings.levels = 1 + upTo(made.settings.depth);
    made.settings.policy = static_cast<octree::OpacityPolicy>(upTo(3));
    made.settings.levelRule = static_cast<octree::LevelRule>(upTo(2));
    made.lattice.depth = made.settings.depth;
    made.lattice.edgeMetres = upTo(2) == 0 ? 128 : 32;
    const double coarsest = made.lattice.cellEdgeMetres(made.settings.depth - made.settings.levels + 1);
    made.lattice.origin =
        glm::dvec3(upTo(41) - 20, upTo(41) - 20, upTo(41) - 20) * coarsest - made.lattice.edgeMetres / 2;

    const auto finest = static_cast<float>(made.lattice.cellEdgeMetres(made.settings.depth));
    const auto edge = static_cast<float>(made.lattice.edgeMetres);
    const float spread = edge * std::exp2(-static_cast<float>(upTo(10)));
    const int kind = upTo(4);
    store.resize(count);
    for (std::size_t i = 0; i < count; ++i) {
        glm::vec3 p = glm::vec3(made.lattice.origin) + edge / 2 +
                      spread * glm::vec3(normal(random), normal(random), normal(random));
        if (kind == 1) p = glm::round(p / finest) * finest;
        if (kind == 2 && i > 0 && upTo(3) > 0) p = store.position(random() % i);
        if (kind == 3 && upTo(8) == 0) p *= 1e30f;
        store.x[i] = p.x;
        store.y[i] = p.y;
        store.z[i] = p.z;
        store.lifetime[i] = 1 + 3 * unit(random);
        store.age[i] = upTo(4) == 0 ? 0.25f : store.lifetime[i] * unit(random);
        store.opacity[i] = upTo(4) == 0 ? 0.125f * static_cast<float>(upTo(3)) : 0.999f * unit(random);
        store.radius[i] = 0.01f + 2 * unit(random);
        store.serial[i] = i * 2654435761u % 4294967291u;  // in another order than in memory
    }
    return made;
}

std::string described(const Case& made, std::size_t count) {
    return "depth " + std::to_string(made.settings.depth) + " levels " + std::to_string(made.settings.levels) +
           " policy " + std::to_string(static_cast<int>(made.settings.policy)) + " rule " +
           std::to_string(static_cast<int>(made.settings.levelRule)) + " particles " + std::to_string(count);
}

/// Voxels equal those of the plain octree, none is missing, they are in pre-order, and the nodes lead to them.
void expectPlain(const Octree& tree, const Case& made, const PlainOctree& plain) {
    ASSERT_EQ(tree.voxels().size(), plain.voxels.size());
    const bool sums = made.settings.policy == octree::OpacityPolicy::accumulate;
    ASSERT_EQ(tree.masses().size(), sums ? plain.voxels.size() : 0);
    std::uint64_t last = 0;
    for (std::size_t i = 0; i < tree.voxels().size(); ++i) {
        const octree::CellEntry voxel = tree.voxels()[i];
        const glm::uvec3 cell = octree::mortonCell(voxel.code()) >> static_cast<unsigned>(voxel.rise());
        const auto found = plain.voxels.find({voxel.rise(), cell.x, cell.y, cell.z});
        ASSERT_NE(found, plain.voxels.end());
        ASSERT_EQ(voxel.index(), found->second.particle);
        if (sums) {
            ASSERT_NEAR(tree.masses()[i], found->second.massSquareMetres, 1e-12 * found->second.massSquareMetres);
        }
        ASSERT_TRUE(i == 0 || voxel.place() > last);
        last = voxel.place();
    }
    std::size_t visited = 0;
    visitBelow(tree.root(), [&](const Octree::Cursor& node) {
        if (!node.hasVoxel()) return;
        EXPECT_EQ(node.voxel(), visited++);
        EXPECT_EQ(tree.voxels()[node.voxel()].code(), node.code());
        EXPECT_EQ(made.settings.depth - tree.voxels()[node.voxel()].rise(), node.level());
    });
    EXPECT_EQ(visited, tree.voxels().size());
}

TEST(OctreePair, GivesTheSameVoxelsInEveryWayOfBuilding) {
    std::mt19937_64 random(20061);
    MemoryLedger ledger;
    ParticleStore store(ledger);
    Octree tree(ledger), first(ledger);
    auto builders = allBuilders(ledger);  // used for all sets: nothing of the previous set may remain
    for (int set = 0; set < 3000; ++set) {
        const std::size_t count = set < 200 ? static_cast<std::size_t>(set % 4) : random() % 400;
        const Case made = makeCase(random, count, store);
        SCOPED_TRACE("set " + std::to_string(set) + ": " + described(made, count));
        const PlainOctree plain = octree::plainOctree(store, made.lattice, made.settings);
        ASSERT_LE(plain.voxels.size(), count);
        for (const NamedBuilder& each : builders) {
            SCOPED_TRACE(each.name);
            Octree& built = &each == builders.data() ? first : tree;
            ASSERT_EQ(each.builder->build(store, made.lattice, made.settings, built), plain.clipped);
            ASSERT_NO_FATAL_FAILURE(expectPlain(built, made, plain));
            ASSERT_TRUE(std::ranges::equal(built.voxels(), first.voxels()));
            ASSERT_TRUE(std::ranges::equal(built.masses(), first.masses()));  // to the last bit
            ASSERT_EQ(countNodes(built), countNodes(first));
        }
    }
}

/// If the edge of a cell is not a power of two, coordinates are rounded: equally in all ways of building.
TEST(OctreePair, GivesTheSameVoxelsInWorldsOfAnyEdge) {
    std::mt19937_64 random(77);
    MemoryLedger ledger;
    ParticleStore store(ledger);
    Octree tree(ledger), first(ledger);
    auto builders = allBuilders(ledger);
    for (int set = 0; set < 1000; ++set) {
        Case made = makeCase(random, 1 + random() % 400, store);
        const double edge = 10 + 0.37 * static_cast<double>(set);
        made.lattice.origin *= edge / made.lattice.edgeMetres;
        for (auto* axis : {&store.x, &store.y, &store.z})
            for (float& place : *axis) place *= static_cast<float>(edge / made.lattice.edgeMetres);
        made.lattice.edgeMetres = edge;
        SCOPED_TRACE("set " + std::to_string(set) + ": " + described(made, store.size()));
        std::int64_t clipped = 0;
        for (const NamedBuilder& each : builders) {
            SCOPED_TRACE(each.name);
            const bool isFirst = &each == builders.data();
            Octree& built = isFirst ? first : tree;
            const std::int64_t outside = each.builder->build(store, made.lattice, made.settings, built);
            if (isFirst) clipped = outside;
            ASSERT_EQ(outside, clipped);
            ASSERT_TRUE(std::ranges::equal(built.voxels(), first.voxels()));
            ASSERT_TRUE(std::ranges::equal(built.masses(), first.masses()));
        }
    }
}

TEST(OctreePair, IsMarchedAlikeInEveryWayOfBuilding) {
    std::mt19937_64 random(40);
    MemoryLedger ledger;
    ParticleStore store(ledger);
    Octree tree(ledger);
    const auto builders = allBuilders(ledger);
    for (int set = 0; set < 200; ++set) {
        const Case made = makeCase(random, 1 + random() % 400, store);
        SCOPED_TRACE("set " + std::to_string(set) + ": " + described(made, store.size()));
        octree::OctreeMarchTree marched, first;
        for (const NamedBuilder& each : builders) {
            each.builder->build(store, made.lattice, made.settings, tree);
            std::vector<float> extinctions(tree.voxels().size());
            for (std::size_t i = 0; i < extinctions.size(); ++i) extinctions[i] = 0.5f + static_cast<float>(i);
            octree::OctreeMarchTree& march = &each == builders.data() ? first : marched;
            march.set({made.lattice, tree.blocks(), extinctions, {}});
            ASSERT_TRUE(std::ranges::equal(march.slots(), first.slots())) << each.name;
        }
    }
}

TEST(OctreePair, GivesTheSameVoxelsOfManyParticlesAtAnyNumberOfThreads) {
    const tbb::global_control maximum(tbb::global_control::max_allowed_parallelism, 8);
    std::mt19937_64 random(7);
    MemoryLedger ledger;
    ParticleStore store(ledger);
    for (int set = 0; set < 6; ++set) {
        const Case made = makeCase(random, 100'000, store);
        SCOPED_TRACE(described(made, store.size()));
        const PlainOctree plain = octree::plainOctree(store, made.lattice, made.settings);
        for (const NamedBuilder& each : allBuilders(ledger)) {
            SCOPED_TRACE(each.name);
            for (const int threads : {1, 2, 5}) {
                Octree tree(ledger);
                tbb::task_arena arena(threads);
                const std::int64_t clipped =
                    arena.execute([&] { return each.builder->build(store, made.lattice, made.settings, tree); });
                ASSERT_EQ(clipped, plain.clipped);
                ASSERT_NO_FATAL_FAILURE(expectPlain(tree, made, plain));
            }
        }
    }
}

/// So many that a sort key cannot contain all bits of a particle's priority, and priorities differ only in the last
/// ones.
TEST(OctreePair, TellsPrioritiesApartByTheirLastBits) {
    constexpr std::size_t count = (1 << 20) + 77;
    std::mt19937_64 random(21);
    MemoryLedger ledger;
    ParticleStore store(ledger);
    Case made = makeCase(random, count, store);
    made.settings.policy = octree::OpacityPolicy::max;
    for (const int depth : {8, 10}) {
        made.settings.depth = made.lattice.depth = depth;
        made.settings.levels = 4;
        for (std::size_t i = 0; i < count; ++i)
            store.opacity[i] = std::bit_cast<float>(0x3d000000u + static_cast<std::uint32_t>(random() % 16));
        const PlainOctree plain = octree::plainOctree(store, made.lattice, made.settings);
        for (const NamedBuilder& each : allBuilders(ledger)) {
            SCOPED_TRACE(each.name);
            Octree tree(ledger);
            EXPECT_EQ(each.builder->build(store, made.lattice, made.settings, tree), plain.clipped);
            ASSERT_NO_FATAL_FAILURE(expectPlain(tree, made, plain));
        }
    }
}

TEST(OctreePair, AccumulatesTheMassOfAllParticlesInside) {
    std::mt19937_64 random(3);
    MemoryLedger ledger;
    ParticleStore store(ledger);
    Case made = makeCase(random, 5000, store);
    made.settings.policy = octree::OpacityPolicy::accumulate;
    const PlainOctree plain = octree::plainOctree(store, made.lattice, made.settings);
    double expected = 0;
    for (const auto& [cell, voxel] : plain.voxels) expected += voxel.massSquareMetres;
    for (const NamedBuilder& each : allBuilders(ledger)) {
        Octree tree(ledger);
        each.builder->build(store, made.lattice, made.settings, tree);
        double sum = 0;
        for (const double mass : tree.masses()) sum += mass;
        EXPECT_NEAR(sum, expected, 1e-9 * expected) << each.name;
    }
}

TEST(OctreePair, AllocatesNothingInASteadyFrame) {
    std::mt19937_64 random(5);
    MemoryLedger stores, ledger;
    ParticleStore store(stores);
    const Case made = makeCase(random, 20'000, store);
    for (const NamedBuilder& each : allBuilders(ledger)) {
        Octree tree(ledger);
        each.builder->build(store, made.lattice, made.settings, tree);
        const octree::NodeBlock* const nodes = tree.blocks().data();
        const octree::CellEntry* const voxels = tree.voxels().data();
        const std::size_t held = ledger.totalBytes();
        for (int frame = 0; frame < 3; ++frame) {
            for (float& x : store.x) x += 0.01f;
            store.resize(store.size() - 50);
            each.builder->build(store, made.lattice, made.settings, tree);
            EXPECT_EQ(ledger.totalBytes(), held) << each.name;
            EXPECT_EQ(tree.blocks().data(), nodes) << each.name;
            EXPECT_EQ(tree.voxels().data(), voxels) << each.name;
        }
    }
}

TEST(OctreePair, StopsAtAPositionThatIsNotANumberAndNamesItsParticle) {
    std::mt19937_64 random(9);
    MemoryLedger ledger;
    ParticleStore store(ledger);
    const Case made = makeCase(random, 3000, store);
    store.y[1234] = std::numeric_limits<float>::quiet_NaN();
    for (const NamedBuilder& each : allBuilders(ledger)) {
        Octree tree(ledger);
        try {
            each.builder->build(store, made.lattice, made.settings, tree);
            ADD_FAILURE() << each.name << " accepted it";
        } catch (const std::runtime_error& error) {
            EXPECT_THAT(error.what(), testing::HasSubstr(std::to_string(store.serial[1234])));
        }
    }
}

TEST(OctreePair, CountsWhatIsEndlesslyFarAwayAsOutside) {
    MemoryLedger ledger;
    ParticleStore store(ledger);
    store.resize(2);
    for (std::size_t i = 0; i < 2; ++i) {
        store.x[i] = i == 0 ? std::numeric_limits<float>::infinity() : 1;
        store.y[i] = store.z[i] = store.age[i] = 0;
        store.lifetime[i] = store.radius[i] = 1;
        store.opacity[i] = 0.5f;
        store.serial[i] = i;
    }
    Lattice lattice;
    lattice.origin = glm::dvec3(-64);
    for (const NamedBuilder& each : allBuilders(ledger)) {
        Octree tree(ledger);
        EXPECT_EQ(each.builder->build(store, lattice, OctreeSettings{}, tree), 1) << each.name;
        EXPECT_EQ(tree.voxels().size(), 1u) << each.name;
    }
}

}  // namespace
}  // namespace dustbench::octree_pair
