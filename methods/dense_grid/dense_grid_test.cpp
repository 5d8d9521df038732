#include "methods/dense_grid/dense_grid.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <random>

#include "methods/contract/errors.h"
#include "methods/contract/method.h"
#include "methods/kit/octree/plain_octree.h"
#include "methods/kit/particles/particle_store.h"
#include "methods/kit/testing/test_input_error.h"
#include "methods/kit/testing/test_moment.h"

namespace dustbench::dense_grid {

MethodInfo describe();

namespace {

using octree::CellEntry;
using octree::Lattice;
using octree::OctreeSettings;
using octree::OpacityPolicy;
using particles::ParticleStore;

void fill(ParticleStore& store, std::size_t count, float spreadMetres, std::mt19937& random) {
    std::normal_distribution<float> normal;
    std::uniform_real_distribution<float> unit(0, 1);
    store.resize(count);
    for (std::size_t i = 0; i < count; ++i) {
        store.serial[i] = i * 2654435761u % 4294967291u;
        store.x[i] = spreadMetres * normal(random);
        store.y[i] = spreadMetres * normal(random);
        store.z[i] = std::round(spreadMetres * normal(random));  // some on the borders of cells
        store.lifetime[i] = 4;
        store.age[i] = 4 * unit(random);
        store.opacity[i] = i % 3 == 0 ? 0.25f : 0.9f * unit(random);
        store.radius[i] = 0.1f + unit(random);
    }
}

TEST(DenseGrid, HasTheVoxelsOfAnOctreesFinestLevel) {
    std::mt19937 random(2004);
    MemoryLedger ledger;
    ParticleStore store(ledger);
    GridBuilder builder(ledger);  // reused for all sets: nothing may remain of the previous one
    octree::Octree tree(ledger);
    for (int set = 0; set < 300; ++set) {
        OctreeSettings settings;
        settings.depth = 4 + static_cast<int>(random() % 3);
        settings.levels = 1;
        settings.policy = static_cast<OpacityPolicy>(random() % 3);
        Lattice lattice;
        lattice.depth = settings.depth;
        lattice.edgeMetres = random() % 2 == 0 ? 128 : 16;
        lattice.origin = glm::dvec3(-lattice.edgeMetres / 2);
        fill(store, random() % 500, 0.5f * static_cast<float>(1u << random() % 7), random);
        const octree::PlainOctree plain = octree::plainOctree(store, lattice, settings);

        ASSERT_EQ(builder.build(store, lattice, settings, tree), plain.clipped);
        ASSERT_EQ(tree.voxels().size(), plain.voxels.size());
        const bool sums = settings.policy == OpacityPolicy::accumulate;
        for (std::size_t i = 0; i < tree.voxels().size(); ++i) {
            const CellEntry voxel = tree.voxels()[i];
            const glm::uvec3 cell = octree::mortonCell(voxel.code());
            const auto found = plain.voxels.find({0, cell.x, cell.y, cell.z});
            ASSERT_NE(found, plain.voxels.end());
            ASSERT_EQ(voxel.index(), found->second.particle);
            ASSERT_EQ(voxel.rise(), 0);
            ASSERT_TRUE(i == 0 || voxel.place() > tree.voxels()[i - 1].place());
            if (sums) {
                ASSERT_NEAR(tree.masses()[i], found->second.massSquareMetres, 1e-12 * found->second.massSquareMetres);
            }
        }
    }
}

TEST(DenseGrid, HoldsEveryCellWhetherThereIsDustOrNot) {
    std::mt19937 random(1);
    for (const OpacityPolicy policy : {OpacityPolicy::max, OpacityPolicy::youngest, OpacityPolicy::accumulate})
        for (const int depth : {4, 5, 6, 7}) {
            MemoryLedger stores, ledger;
            ParticleStore store(stores);
            GridBuilder builder(ledger);
            octree::Octree tree(ledger);
            OctreeSettings settings;
            settings.depth = depth;
            settings.levels = 1;
            settings.policy = policy;
            Lattice lattice;
            lattice.depth = depth;
            lattice.origin = glm::dvec3(-64);
            const std::size_t cells = std::size_t{1} << 3 * depth;
            const std::size_t expected = cells * (policy == OpacityPolicy::accumulate ? 12 : 4);
            for (const std::size_t count : {0u, 1u, 1000u}) {
                fill(store, count, 10, random);
                builder.build(store, lattice, settings, tree);
                EXPECT_EQ(ledger.account("dense grid").bytes(), expected);
                EXPECT_EQ(builder.structureBytes(tree), expected);
                EXPECT_EQ(gridBytes(depth, policy), expected);
            }
        }
}

TEST(DenseGrid, TellsItsBytesAndShowsItsVoxels) {
    TestMoment moment(400, 160, 120, {0, 6, 24}, {0, -5, -24});
    std::mt19937 random(3);
    fill(moment.dust, 400, 2, random);
    const MethodInfo info = describe();
    ParameterValues values(info.parameters);
    values.set("depth", "6");
    const auto method = info.create(values);
    method->prepare(moment.scene, {}, TestMoment::device());
    const pictures::Image image = moment.updateAndDraw(*method);
    EXPECT_EQ(moment.draw(*method).pixels, image.pixels);
    double alpha = 0;
    for (const glm::vec4& pixel : image.pixels) alpha += static_cast<double>(pixel.a);
    EXPECT_GT(alpha, 100);
    EXPECT_GT(method->primitives(), 10);
    Facts facts(info.facts, FactOver::maximumOfFrames);
    method->report(moment.frame(), facts);
    EXPECT_EQ(std::get<std::int64_t>(facts.value("structure_bytes").value()), 64 * 64 * 64 * 4);
    std::size_t booked = 0;
    for (const MemoryUse& use : method->memory()) booked += use.structure == "dense grid" ? use.cpuBytes : 0;
    EXPECT_EQ(booked, 64u * 64 * 64 * 4);
}

TEST(DenseGrid, RefusesMoreBytesThanAllowed) {
    const MethodInfo info = describe();
    const auto create = [&](const char* depth, const char* policy, const char* limit) {
        ParameterValues values(info.parameters);
        values.set("depth", depth);
        values.set("policy", policy);
        values.set("limit_bytes", limit);
        return info.create(values);
    };
    const auto refused = [&](auto... given) { return inputError([&] { (void)create(given...); }); };
    EXPECT_NE(create("6", "max", "1048576"), nullptr);
    EXPECT_NE(create("4", "accumulate", "49152"), nullptr);
    EXPECT_EQ(refused("6", "max", "1048575"),
              "parameter depth: got 6, a grid of 64³ cells of 4 bytes = 1048576 bytes; allowed: 1048575 bytes "
              "(limit_bytes), which is depth 5 or less");
    EXPECT_THAT(refused("6", "accumulate", "1048576"), testing::HasSubstr("64³ cells of 12 bytes = 3145728 bytes"));
    EXPECT_THAT(refused("12", "max", "2147483648"), testing::HasSubstr("274877906944 bytes; allowed: 2147483648"));
}

}  // namespace
}  // namespace dustbench::dense_grid
