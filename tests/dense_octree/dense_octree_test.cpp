// A dense grid and an octree of one level give the same voxels and the same picture, but use different memory.
#include <gtest/gtest.h>

#include <functional>
#include <random>
#include <string>
#include <tuple>
#include <vector>

#include "methods/contract/method.h"
#include "methods/kit/testing/test_moment.h"

namespace dustbench {

namespace dense_grid {
MethodInfo describe();
}
namespace octree_search {
MethodInfo describe();
}
namespace octree_recursive {
MethodInfo describe();
}

namespace {

using Values = std::vector<std::pair<std::string, std::string>>;

/// A trail behind a vehicle at the world's origin, with particles on the borders of cells and in the same place.
class Trail : public TestMoment {
 public:
    Trail(std::size_t count, std::uint32_t seed) : TestMoment(count, 120, 90, {0, 6, 24}, {-6, -5, -24}) {
        std::mt19937 random(seed);
        std::uniform_real_distribution<float> unit(0, 1);
        for (std::size_t i = 0; i < count; ++i) {
            const float life = unit(random);
            dust.serial[i] = count - i;
            dust.x[i] = i % 5 == 0 ? std::round(-30 * life) : -30 * life;
            dust.y[i] = 3 * unit(random);
            dust.z[i] = i % 7 == 3 ? dust.z[i - 1] : 6 * unit(random) - 3;
            dust.radius[i] = 0.3f + life;
            dust.opacity[i] = i % 4 == 0 ? 0.1f : 0.3f * unit(random);
            dust.lifetime[i] = 4;
            dust.age[i] = 4 * life;
        }
        dust.colourOfAll = {0.6f, 0.5f, 0.4f};
    }
};

class Voxels final : public VolumeVisitor {
 public:
    void puffs(const Puffs&) override { ADD_FAILURE() << "puffs"; }
    void grid(const GridVolume&) override { ADD_FAILURE() << "grid"; }
    void octree(const OctreeVolume& volume) override {
        for (const OctreeVoxel& voxel : volume.voxels)
            all.emplace_back(voxel.x, voxel.y, voxel.z, voxel.level, voxel.extinctionPerMetre, voxel.ageSeconds);
    }
    std::vector<std::tuple<std::uint32_t, std::uint32_t, std::uint32_t, int, float, float>> all;
};

struct Shown {
    pictures::Image image;
    Voxels voxels;
    std::int64_t structureBytes;
};

Shown show(const MethodInfo& info, const Values& given, TestMoment& trail) {
    ParameterValues values(info.parameters);
    for (const auto& [name, value] : given) values.set(name, value);
    const auto method = info.create(values);
    method->prepare(trail.scene, {}, TestMoment::device());
    Shown shown{trail.updateAndDraw(*method), {}, 0};
    method->volume(trail.frame(), shown.voxels);
    Facts facts(info.facts, FactOver::maximumOfFrames);
    method->report(trail.frame(), facts);
    shown.structureBytes = std::get<std::int64_t>(facts.value("structure_bytes").value());
    return shown;
}

Values with(Values values, const Values& more) {
    values.insert(values.end(), more.begin(), more.end());
    return values;
}

TEST(DenseOctree, ShowTheSameVoxelsAndTheSamePicture) {
    for (const std::uint32_t seed : {1u, 2u, 3u})
        for (const char* depth : {"5", "7"})
            for (const Values& drawn : {Values{{"policy", "max"}}, Values{{"policy", "youngest"}, {"render", "cubes"}},
                                        Values{{"policy", "accumulate"}, {"sort", "quicksort"}},
                                        Values{{"mode", "paper"}}, Values{{"sort", "none"}}}) {
                Trail trail(600, seed);
                const Values both = with(drawn, {{"depth", depth}});
                const Shown dense = show(dense_grid::describe(), both, trail);
                ASSERT_GT(dense.voxels.all.size(), 10u);
                for (const auto& describe : {octree_search::describe, octree_recursive::describe}) {
                    const Shown tree = show(describe(), with(both, {{"levels", "1"}}), trail);
                    EXPECT_EQ(dense.voxels.all, tree.voxels.all);
                    EXPECT_EQ(dense.image.pixels, tree.image.pixels);
                }
            }
}

TEST(DenseOctree, OneGrowsWithTheCellsTheOtherWithTheVoxels) {
    Trail trail(600, 4);
    std::vector<std::int64_t> dense, tree;
    for (const char* depth : {"5", "6", "7", "8"}) {
        dense.push_back(show(dense_grid::describe(), {{"depth", depth}}, trail).structureBytes);
        tree.push_back(show(octree_search::describe(), {{"depth", depth}, {"levels", "1"}}, trail).structureBytes);
    }
    for (std::size_t i = 1; i < dense.size(); ++i) {
        EXPECT_EQ(dense[i], 8 * dense[i - 1]);
        EXPECT_LT(tree[i], 8 * tree[i - 1]);
    }
    // At most one block of 64 bytes per level and one voxel of 8 bytes for each particle, plus the root's block.
    EXPECT_LE(tree.back(), 600 * (8 * 64 + 8) + 64);
}

/// No empty space: a particle in each of 16³ cells.
TEST(DenseOctree, TheTreeNeedsMoreBytesThanTheGridWhereAllIsFull) {
    TestMoment full(4096, 40, 30, {0, 0, 100}, {0, 0, -1});
    for (std::size_t i = 0; i < 4096; ++i) {
        full.dust.serial[i] = i;
        const std::size_t column = i % 16, row = i / 16 % 16, slab = i / 256;
        full.dust.x[i] = -60 + 8 * static_cast<float>(column);
        full.dust.y[i] = -60 + 8 * static_cast<float>(row);
        full.dust.z[i] = -60 + 8 * static_cast<float>(slab);
        full.dust.radius[i] = full.dust.lifetime[i] = 1;
        full.dust.age[i] = 0;
        full.dust.opacity[i] = 0.1f;
    }
    EXPECT_EQ(show(dense_grid::describe(), {{"depth", "4"}}, full).structureBytes, 4 * 4096);
    // Blocks of eight nodes for the root and for all nodes of levels 1 to 3.
    EXPECT_EQ(show(octree_search::describe(), {{"depth", "4"}, {"levels", "1"}}, full).structureBytes,
              8 * 4096 + 64 * (1 + 8 + 64 + 512));
}

}  // namespace
}  // namespace dustbench
