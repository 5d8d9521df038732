#include "bench/export/extinction_grid.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <oneapi/tbb/global_control.h>
#include <oneapi/tbb/task_arena.h>

#include <cmath>
#include <limits>

#include "bench/export/test_clouds.h"
#include "methods/kit/testing/test_folder.h"

namespace dustbench::exports {
namespace {

using testing::HasSubstr;

/// The average of a function over a cell, by the midpoint rule on a lattice of points.
template <typename Function>
double cellAverage(const GridPlan& plan, int i, int j, int k, int points, const Function& at) {
    double sum = 0;
    for (int c = 0; c < points; ++c)
        for (int b = 0; b < points; ++b)
            for (int a = 0; a < points; ++a)
                sum += at(plan.origin +
                          plan.spacingMetres * (glm::dvec3(i, j, k) + (glm::dvec3(a, b, c) + 0.5) / double(points)));
    return sum / points / points / points;
}

template <typename Check>
void forEachCell(const ExtinctionGrid& grid, const Check& check) {
    std::size_t cell = 0;
    for (int k = 0; k < grid.plan.cells[2]; ++k)
        for (int j = 0; j < grid.plan.cells[1]; ++j)
            for (int i = 0; i < grid.plan.cells[0]; ++i)
                check(i, j, k, static_cast<double>(grid.extinctionPerMetre[cell++]));
    EXPECT_EQ(cell, grid.extinctionPerMetre.size());
}

TEST(ExtinctionGrid, OfAGridIsThatGridAndKeepsItsMassOnAnother) {
    const TestGrid test;
    const CollectedVolume volume = test.volume();
    const ExtinctionGrid same = computeGrid(volume, {{10, 20, 30}, 0.25, {5, 4, 3}});
    for (std::size_t c = 0; c < 60; ++c) EXPECT_NEAR(same.extinctionPerMetre[c], test.extinction[c], 1e-4) << c;
    const ExtinctionGrid coarse = computeGrid(volume, planGrid(Box{{9.9, 19.8, 29.9}, {11.4, 21.1, 30.9}}, 7));
    EXPECT_NEAR(coarse.massSquareMetres(), same.massSquareMetres(), 1e-5 * same.massSquareMetres());
    EXPECT_EQ(volume.bounds()->minimum, glm::dvec3(10, 20, 30));
    EXPECT_EQ(volume.bounds()->maximum, glm::dvec3(11.25, 21, 30.75));
}

TEST(CollectedVolume, RefusesGridsThatAreNone) {
    std::vector<float> values(8, 1);
    CollectedVolume volume;
    EXPECT_THROW(volume.grid({{}, 1, {2, 2, 3}, values, {}}), std::runtime_error);
    values[5] = std::numeric_limits<float>::quiet_NaN();
    EXPECT_THROW(volume.grid({{}, 1, {2, 2, 2}, values, {}}), std::runtime_error);
}

TEST(ExtinctionGrid, HoldsTheCellAveragesOfPuffsThatQuadratureGives) {
    for (const unsigned seed : {1u, 2u, 3u}) {
        const TestDust dust(6, 2, 0.5f, seed);
        // Not the cloud's own box: puffs are cut at every side.
        const GridPlan plan = planGrid(Box{{4, -1, -8.5}, {7, 1.3, -6.1}}, 6);
        const ExtinctionGrid grid = computeGrid(dust.volume(), plan);
        forEachCell(grid, [&](int i, int j, int k, double got) {
            const double expected = cellAverage(plan, i, j, k, 24, [&](const glm::dvec3& at) {
                double sum = 0;
                for (std::size_t p = 0; p < dust.store.size(); ++p)
                    sum += maths::puffExtinctionPerMetre(static_cast<double>(dust.store.opacity[p]),
                                                         static_cast<double>(dust.store.radius[p]),
                                                         glm::distance(at, glm::dvec3(dust.store.position(p))));
                return sum;
            });
            EXPECT_NEAR(got, expected, 1e-3 * expected + 1e-5) << i << " " << j << " " << k;
        });
    }
}

TEST(ExtinctionGrid, HoldsTheCellAveragesOfVoxelsThatTheirOverlapGives) {
    const CollectedOctree octree = testOctree(300, 5, 3, 4);
    // 12 points per cell, spaced 1/3 of the finest voxel's edge and shifted by half a spacing: no point lies on a
    // voxel's side.
    const GridPlan plan{{-20, -30, 70}, 4.0 / 3, {9, 7, 8}};
    const ExtinctionGrid grid = computeGrid(volumeOf(octree), plan);
    double largest = 0;
    forEachCell(grid, [&](int i, int j, int k, double got) {
        double expected = 0;
        const glm::dvec3 minimum = plan.origin + plan.spacingMetres * glm::dvec3(i, j, k);
        for (const OctreeVoxel& voxel : octree.voxels) {
            const glm::dvec3 corner = octree.minimumCorner(voxel);
            const glm::dvec3 shared =
                glm::max(glm::min(minimum + plan.spacingMetres, corner + octree.cellEdgeMetres(voxel.level)) -
                             glm::max(minimum, corner),
                         glm::dvec3(0));
            expected += static_cast<double>(voxel.extinctionPerMetre) * shared.x * shared.y * shared.z /
                        std::pow(plan.spacingMetres, 3);
        }
        EXPECT_NEAR(got, expected, 1e-5 * expected) << i << " " << j << " " << k;
        largest = std::max(largest, expected);
    });
    EXPECT_GT(largest, 0);
}

TEST(ExtinctionGrid, KeepsTheMassOfPuffsHoweverCoarse) {
    const TestDust dust(2000, 10, 0.05f, 5);
    const CollectedVolume volume = dust.volume();
    for (const int resolution : {1, 3, 16, 100}) {
        const ExtinctionGrid grid = computeGrid(volume, planGrid(volume.bounds(), resolution));
        EXPECT_NEAR(grid.massSquareMetres() / dust.massSquareMetres(), 1, 1e-4) << resolution;
    }
}

TEST(ExtinctionGrid, KeepsTheMassOfVoxelsHoweverCoarse) {
    for (const unsigned seed : {6u, 7u}) {
        const CollectedOctree octree = testOctree(3000, 8, 4, seed);
        const CollectedVolume volume = volumeOf(octree);
        for (const int resolution : {1, 7, 64}) {
            const ExtinctionGrid grid = computeGrid(volume, planGrid(volume.bounds(), resolution));
            EXPECT_NEAR(grid.massSquareMetres() / massSquareMetres(octree), 1, 1e-5) << resolution;
        }
    }
}

TEST(ExtinctionGrid, IsTheSameAtAnyNumberOfThreads) {
    const TestDust dust(3000, 10, 0.1f, 8);
    CollectedVolume volume = volumeOf(testOctree(500, 6, 4, 9));
    volume.puffs(dust.store);
    const GridPlan plan = planGrid(volume.bounds(), 70);
    std::vector<std::vector<float>> grids;
    for (const int threads : {1, 2, 5}) {
        const oneapi::tbb::global_control limit(oneapi::tbb::global_control::max_allowed_parallelism,
                                                static_cast<std::size_t>(threads));
        oneapi::tbb::task_arena arena(threads);
        arena.execute([&] { grids.push_back(computeGrid(volume, plan).extinctionPerMetre); });
    }
    EXPECT_EQ(grids[0], grids[1]);
    EXPECT_EQ(grids[0], grids[2]);
}

TEST(ExtinctionGrid, CoversItsBoxWithCubesOfWhichTheLongestEdgeHasAsManyAsAsked) {
    const Box box{{-3, 1, 2}, {7, 3.05, 12}};
    for (const int resolution : {1, 2, 3, 10, 128, 1000}) {
        const GridPlan plan = planGrid(box, resolution);
        EXPECT_EQ(plan.cells[0], resolution);
        EXPECT_EQ(plan.cells[2], resolution);
        EXPECT_EQ(plan.origin, box.minimum);
        for (int axis = 0; axis < 3; ++axis) {
            const double end = plan.origin[axis] + plan.spacingMetres * plan.cells[static_cast<std::size_t>(axis)];
            EXPECT_GE(end, box.maximum[axis] - 1e-6);
            EXPECT_LT(end, box.maximum[axis] + plan.spacingMetres);
        }
    }
}

TEST(ExtinctionGrid, OfAnEmptyCloudIsOneEmptyCell) {
    for (const CollectedVolume& volume : {TestDust(0, 1, 1, 1).volume(), volumeOf({{0, 0, 0}, 128, 8, {}})}) {
        EXPECT_FALSE(volume.isNothing());
        const ExtinctionGrid grid = computeGrid(volume, planGrid(volume.bounds(), 128));
        EXPECT_THAT(grid.extinctionPerMetre, testing::ElementsAre(0.0f));
    }
    // A requested region is kept.
    const ExtinctionGrid grid = computeGrid(TestDust(0, 1, 1, 1).volume(), planGrid(Box{{0, 0, 0}, {2, 1, 1}}, 4));
    EXPECT_EQ(grid.extinctionPerMetre, std::vector<float>(4 * 2 * 2, 0.0f));
}

TEST(ExtinctionGrid, PuffsWithoutMassDoNotWidenTheGrid) {
    TestDust dust(3, 1, 0.1f, 10);
    dust.store.x[0] = 1e6f;
    dust.store.radius[0] = 0;
    dust.store.y[1] = -1e6f;
    dust.store.opacity[1] = 0;
    const Box bounds = dust.volume().bounds().value();
    EXPECT_LT(bounds.extent().x, 10);
    EXPECT_LT(bounds.extent().y, 10);
}

TEST(ExtinctionGrid, ThatNeedsMoreThanThereIsIsRefusedWithBothNumbers) {
    VolumeSettings settings;
    const GridPlan plan = planGrid(Box{{0, 0, 0}, {1, 1, 1}}, 2048);
    const std::int64_t bytes = std::int64_t{2048} * 2048 * 2048 * 4;
    EXPECT_NO_THROW(requireMemory(plan, settings, bytes));
    EXPECT_THAT(inputError([&] { requireMemory(plan, settings, bytes - 1); }),
                testing::AllOf(HasSubstr(std::to_string(bytes)), HasSubstr(std::to_string(bytes - 1))));
    settings.formats = {"vti", "vdb"};
    EXPECT_THAT(inputError([&] { requireMemory(plan, settings, 2 * bytes); }), HasSubstr(std::to_string(2 * bytes)));
    settings.formats = {"vtp"};  // needs no grid
    EXPECT_NO_THROW(requireMemory(plan, settings, 0));
}

TEST(CollectedVolume, NamesTheParticleThatIsNoWhere) {
    for (const float wrong : {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity()}) {
        TestDust dust(5, 1, 1, 11);
        dust.store.y[3] = wrong;
        try {
            (void)dust.volume();
            FAIL() << "nothing thrown";
        } catch (const std::runtime_error& error) {
            EXPECT_THAT(error.what(), HasSubstr("particle " + std::to_string(dust.store.serial[3]) + ":"));
        }
    }
}

TEST(CollectedVolume, RefusesVoxelsOutsideTheTree) {
    for (const OctreeVoxel& voxel : {OctreeVoxel{8, 0, 0, 3, 1, 0}, OctreeVoxel{0, 0, 0, 5, 1, 0},
                                     OctreeVoxel{0, 0, 0, -1, 1, 0}, OctreeVoxel{0, 0, 0, 3, NAN, 0}})
        EXPECT_THROW((void)volumeOf({{0, 0, 0}, 1, 4, {voxel}}), std::runtime_error) << voxel.x << " " << voxel.level;
}

}  // namespace
}  // namespace dustbench::exports
