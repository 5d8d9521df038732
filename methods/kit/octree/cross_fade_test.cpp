#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <memory>
#include <vector>

#include "methods/kit/octree/map_builder_test_tree.h"
#include "methods/kit/octree/octree_dust.h"
#include "methods/kit/octree/voxel_cloud.h"
#include "methods/kit/testing/test_moment.h"

namespace dustbench::octree {
namespace {

/// A cloud of one voxel on a lattice.
VoxelCloud oneVoxel(MemoryLedger& ledger, const Lattice& lattice, const glm::uvec3& cell, float mass) {
    VoxelCloud cloud(ledger);
    cloud.lattice = lattice;
    cloud.resize(1, false);
    cloud.place[0] = CellEntry(mortonCode(cell.x, cell.y, cell.z), 0, 0).place();
    cloud.mass[0] = mass;
    cloud.age[0] = 0;
    cloud.locate(0);
    return cloud;
}

TEST(CrossFade, FollowsByTheLawOfItsTimeConstant) {
    MemoryLedger ledger;
    const Lattice lattice;
    CrossFade fade(ledger, 0.2);
    VoxelCloud nothing(ledger);
    nothing.lattice = lattice;
    fade.follow(nothing, 0.05);
    const VoxelCloud target = oneVoxel(ledger, lattice, {3, 4, 5}, 0.5f);
    for (int n = 1; n <= 8; ++n) {
        const VoxelCloud& shown = fade.follow(target, 0.05);
        ASSERT_EQ(shown.size(), 1u);
        EXPECT_NEAR(shown.mass[0], 0.5 * (1 - std::exp(-n * 0.05 / 0.2)), 1e-6);
    }
    const float held = fade.follow(target, 0.05).mass[0];
    EXPECT_NEAR(fade.follow(nothing, 0.05).mass[0], static_cast<double>(held) * std::exp(-0.05 / 0.2), 1e-6);
    for (int n = 0; n < 100; ++n) fade.follow(nothing, 0.05);
    EXPECT_EQ(fade.follow(nothing, 0.05).size(), 0u);  // the voxel is gone
}

TEST(CrossFade, StaysWhereItIsWhileTheWorldMoves) {
    MemoryLedger ledger;
    Lattice lattice;
    lattice.origin = glm::dvec3(-64);
    CrossFade fade(ledger, 0.2);
    fade.follow(oneVoxel(ledger, lattice, {130, 128, 120}, 1), 0.05);
    const float x = fade.follow(oneVoxel(ledger, lattice, {130, 128, 120}, 1), 0.05).x[0];
    Lattice moved = lattice;
    moved.origin.x += 4;  // shifted by eight finest cells
    const VoxelCloud& shown = fade.follow(oneVoxel(ledger, moved, {122, 128, 120}, 1), 0.05);
    ASSERT_EQ(shown.size(), 1u);
    EXPECT_NEAR(shown.mass[0], 1, 1e-6);
    EXPECT_EQ(shown.x[0], x);
    // In a world twice as wide, with one more level.
    Lattice grown = moved;
    grown.origin -= 64;
    grown.edgeMetres = 256;
    grown.depth = 9;
    const VoxelCloud& same = fade.follow(oneVoxel(ledger, grown, {250, 256, 248}, 1), 0.05);
    ASSERT_EQ(same.size(), 1u);
    EXPECT_NEAR(same.mass[0], 1, 1e-6);
    EXPECT_EQ(same.x[0], x);
    fade.follow(oneVoxel(ledger, moved, {122, 128, 120}, 1), 0.05);
    // Outside the world: dropped.
    moved.origin.x += 256;
    VoxelCloud nothing(ledger);
    nothing.lattice = moved;
    EXPECT_EQ(fade.follow(nothing, 0.05).size(), 0u);
}

/// Advances by one frame at which `cell` holds a voxel of this mass, and returns the masses to draw by cell.
std::map<int, float> keptAfterFrame(MemoryLedger& ledger, KeptVoxels& kept, unsigned cell, float mass) {
    if (kept.advance(0.05)) {
        VoxelCloud built = oneVoxel(ledger, Lattice(), {cell, 4, 5}, mass);
        kept.take(built);
    }
    const VoxelCloud& shown = kept.between();
    std::map<int, float> masses;
    for (std::size_t i = 0; i < shown.size(); ++i)
        masses[static_cast<int>(mortonCell(shown.code(i)).x)] = shown.mass[i];
    return masses;
}

TEST(KeptVoxels, AreShownLinearlyBetweenTheLastTwoTrees) {
    MemoryLedger ledger;
    KeptVoxels kept(ledger, 0.2);  // four frames
    for (int frame = 0; frame < 4; ++frame)
        EXPECT_FLOAT_EQ(keptAfterFrame(ledger, kept, 3, 0.5f).at(3), 0.5f);  // a second tree is not there yet
    for (int frame = 0; frame < 4; ++frame) {                                // built: mass 1 in the same cell
        EXPECT_NEAR(keptAfterFrame(ledger, kept, 3, 1).at(3), 0.5 + 0.5 * frame / 4, 1e-6) << frame;
    }
    for (int frame = 0; frame < 4; ++frame) {  // built: mass 1 in another cell
        const std::map<int, float> masses = keptAfterFrame(ledger, kept, 9, 1);
        EXPECT_NEAR(masses.at(3), 1 - frame / 4.0, 1e-6) << frame;
        EXPECT_NEAR(masses.at(9), frame / 4.0, 1e-6) << frame;
    }
    EXPECT_EQ(keptAfterFrame(ledger, kept, 9, 1), (std::map<int, float>{{9, 1.0f}}));
}

TEST(KeptVoxels, AreKeptForWholeFramesSoThatNothingJumpsAtTheirEnd) {
    MemoryLedger ledger;
    KeptVoxels kept(ledger, 0.12);  // three frames of 0.05 s
    std::vector<float> masses(12);
    for (std::size_t frame = 0; frame < masses.size(); ++frame)
        masses[frame] = keptAfterFrame(ledger, kept, 3, frame < 3 ? 1 : 4).at(3);
    for (std::size_t i = 1; i < masses.size(); ++i) EXPECT_LE(masses[i] - masses[i - 1], 1.001f) << i;
    EXPECT_FLOAT_EQ(masses.front(), 1);
    EXPECT_FLOAT_EQ(masses.back(), 4);
}

/// A few puffs in a row, for methods that show a tree for a while.
class DriftingDust : public TestMoment {
 public:
    DriftingDust() : TestMoment(60, 160, 120, {0, 6, 24}, {-6, -5, -24}) {
        for (std::size_t i = 0; i < dust.size(); ++i) {
            const float share = static_cast<float>(i) / 60;
            dust.serial[i] = i;
            dust.x[i] = -12 * share;
            dust.y[i] = 0.5f + 2 * std::fmod(7.3f * share, 1.0f);
            dust.z[i] = 3 * std::fmod(11.7f * share, 1.0f) - 1.5f;
            dust.radius[i] = 0.3f + share;
            dust.opacity[i] = 0.1f;
            dust.lifetime[i] = 4;
            dust.age[i] = 4 * share;
        }
    }
};

OctreeDust overMap(const DustSettings& settings) {
    return {settings, [](MemoryLedger&) { return std::make_unique<MapBuilder>(); }};
}

double summedAlpha(const pictures::Image& image) {
    double sum = 0;
    for (const glm::vec4& pixel : image.pixels) sum += static_cast<double>(pixel.a);
    return sum;
}

TEST(OctreeDust, CrossFadingLeavesLessToPop) {
    std::map<bool, double> jump;
    for (const bool fades : {false, true}) {
        DriftingDust moment;
        DustSettings settings;
        settings.render = Render::raycast;
        settings.crossFade = fades;
        OctreeDust method = overMap(settings);
        method.prepare(moment.scene, {}, DriftingDust::device());
        pictures::Image last = moment.updateAndDraw(method);
        for (int frame = 0; frame < 12; ++frame) {
            for (float& x : moment.dust.x) x += 0.05f;
            const pictures::Image now = moment.updateAndDraw(method);
            for (std::size_t i = 0; i < now.pixels.size(); ++i)
                jump[fades] += std::pow(static_cast<double>(now.pixels[i].a - last.pixels[i].a), 2);
            last = now;
        }
    }
    EXPECT_LT(std::sqrt(jump[true]), 0.4 * std::sqrt(jump[false]));
}

/// Whenever a tree is built, here every second frame, the one before is shown whole; by the ray march too.
TEST(OctreeDust, KeepsATreeAndShowsItsVoxelsLater) {
    for (const Render render : {Render::billboards, Render::raycast}) {
        DriftingDust moment;
        DustSettings settings;
        settings.render = render;
        OctreeDust rebuilt = overMap(settings);
        settings.keepSeconds = 2 * moment.frame().stepSeconds;
        OctreeDust kept = overMap(settings);
        for (OctreeDust* method : {&rebuilt, &kept}) method->prepare(moment.scene, {}, DriftingDust::device());
        std::vector<double> depths;
        for (std::size_t frame = 0; frame < 9; ++frame) {
            depths.push_back(summedAlpha(moment.updateAndDraw(rebuilt)));
            const double shown = summedAlpha(moment.updateAndDraw(kept));
            if (frame >= 2 && frame % 2 == 0) {
                EXPECT_NEAR(shown / depths[frame - 2], 1, 1e-5) << frame;
            }
            for (float& x : moment.dust.x) x += 0.3f;
        }
        EXPECT_GT(std::abs(depths[8] / depths[6] - 1), 1e-3);  // so that showing the wrong tree would be seen
    }
}

}  // namespace
}  // namespace dustbench::octree
