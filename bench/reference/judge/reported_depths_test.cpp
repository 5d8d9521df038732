#include "bench/reference/judge/reported_depths.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <oneapi/tbb/task_arena.h>

#include <cmath>

#include "bench/measure/image/volume_error.h"
#include "bench/reference/judge/judgement.h"
#include "bench/reference/particle_image.h"
#include "bench/reference/test_clouds.h"

namespace dustbench::reference {
namespace {

std::size_t middlePixel(const scene::View& view) {
    return static_cast<std::size_t>(view.height / 2 * view.width + view.width / 2);
}

/// One voxel of this edge around the origin.
exports::CollectedVolume oneVoxel(double edge, float extinction) {
    const OctreeVoxel voxel{0, 0, 0, 0, extinction, 0};
    exports::CollectedVolume volume;
    volume.octree({glm::dvec3(-edge / 2), edge, 3, {&voxel, 1}});
    return volume;
}

TEST(ReportedDepths, OfACubeIsItsExtinctionTimesTheWayThroughIt) {
    const exports::CollectedVolume volume = oneVoxel(2, 0.3f);
    const double extinction = static_cast<double>(0.3f);
    const auto depthFrom = [&](const glm::dvec3& eye, double opaqueMetres) {
        // An odd size: the middle pixel looks straight at the origin.
        const scene::View view = test::viewFrom(eye, {0, 0, 0}, 25, 19);
        OpaqueDistances distances = skyDistances(view);
        distances.metres.assign(distances.metres.size(), opaqueMetres);
        return reportedDepths(volume, view, distances)[middlePixel(view)];
    };
    // The axes of a view are in single precision.
    EXPECT_NEAR(depthFrom({0, 0, 9}, 1e9), 2 * extinction, 1e-6);
    EXPECT_NEAR(depthFrom({-5, 5, 5}, 1e9), 2 * std::sqrt(3.0) * extinction, 1e-6);  // along its diagonal
    EXPECT_NEAR(depthFrom({0, 0, 0.5}, 1e9), 1.5 * extinction, 1e-6);                // from within
    EXPECT_NEAR(depthFrom({0, 0, 9}, 8.25), 0.25 * extinction, 1e-6);                // cut by the scene
    EXPECT_EQ(depthFrom({0, 0, 9}, 7), 0);
}

TEST(ReportedDepths, OfPuffsAreThoseOfTheExactPicture) {
    MemoryLedger ledger;
    for (const std::uint64_t seed : {1, 2, 3}) {
        const auto store = test::ball(ledger, seed, 50, {0, 1, 0}, 3, 0.8f);
        const scene::View view = test::viewFrom({-7, 2, 5}, {0, 0.5, 0});
        const OpaqueDistances ground = test::groundDistances(view, 0);
        exports::CollectedVolume volume;
        volume.puffs(store);
        EXPECT_EQ(reportedDepths(volume, view, ground), renderParticles(store, view, ground).opticalDepths);
    }
}

/// The same random cells as a grid and as an octree's voxels of one level.
struct SameCells {
    exports::CollectedVolume asGrid, asVoxels;

    explicit SameCells(std::uint64_t seed) {
        constexpr int cells = 8;
        const glm::dvec3 origin(-2.3, -1.1, -1.9);
        std::vector<float> extinctions;
        std::vector<OctreeVoxel> voxels;
        for (std::uint32_t z = 0; z < cells; ++z)
            for (std::uint32_t y = 0; y < cells; ++y)
                for (std::uint32_t x = 0; x < cells; ++x) {
                    const auto lot = maths::uniform4(seed, 5, extinctions.size());
                    extinctions.push_back(lot[0] < 0.4f ? lot[1] : 0);
                    if (extinctions.back() > 0) voxels.push_back({x, y, z, 3, extinctions.back(), 0});
                }
        asGrid.grid({origin, 0.5, {cells, cells, cells}, extinctions, {}});
        asVoxels.octree({origin, 4, 3, voxels});
    }
};

TEST(ReportedDepths, OfAGridAreThoseOfItsCellsAsVoxels) {
    for (const std::uint64_t seed : {1, 2, 3}) {
        const SameCells same(seed);
        for (const auto& [eye, target] : std::vector<std::pair<glm::dvec3, glm::dvec3>>{
                 {{7, 2, 5}, {0, 1, 0}}, {{0.1, 0.4, 0.3}, {1, 0.4, 0.3}}, {{-6, -3, -2}, {0, 0, 0}}}) {
            const scene::View view = test::viewFrom(eye, target, 41, 31);
            OpaqueDistances distances = skyDistances(view);
            for (std::size_t i = 0; i < distances.metres.size(); i += 3)
                distances.metres[i] = 9 * static_cast<double>(maths::uniform4(seed, 6, i)[0]);
            const auto grid = reportedDepths(same.asGrid, view, distances);
            const auto voxels = reportedDepths(same.asVoxels, view, distances);
            double most = 0;
            for (std::size_t i = 0; i < grid.size(); ++i) {
                EXPECT_NEAR(grid[i], voxels[i], 1e-11) << seed << " " << i;
                most = std::max(most, grid[i]);
            }
            EXPECT_GT(most, 0.3);
        }
    }
}

TEST(ReportedDepths, OfSeveralPartsAddUpAtAnyNumberOfThreads) {
    MemoryLedger ledger;
    const auto store = test::ball(ledger, 4, 30, {0, 0, 0}, 2, 0.5f);
    const scene::View view = test::viewFrom({7, 2, 5}, {0, 1, 0});
    const OpaqueDistances sky = skyDistances(view);
    const SameCells same(9);
    SameCells both(9);
    exports::CollectedVolume puffs, &all = both.asGrid;
    puffs.puffs(store);
    all.puffs(store);
    const auto a = reportedDepths(same.asGrid, view, sky), b = reportedDepths(puffs, view, sky);
    for (const int threads : {1, 2, 5}) {
        std::vector<double> sum;
        oneapi::tbb::task_arena(threads).execute([&] { sum = reportedDepths(all, view, sky); });
        for (std::size_t i = 0; i < sum.size(); ++i) EXPECT_EQ(sum[i], b[i] + a[i]);
    }
}

TEST(VolumePicture, IsZeroForTheSameAndOneForNothing) {
    const scene::View view = test::viewFrom({7, 2, 5}, {0, 1, 0});
    const measure::Plane alpha = reportedAlpha(oneVoxel(2, 0.3f), view, skyDistances(view));
    const measure::Plane none(view.width, view.height);
    EXPECT_EQ(measure::volumePicture(alpha, alpha), 0);
    EXPECT_EQ(measure::volumePicture(alpha, none), 1);
    EXPECT_EQ(measure::volumePicture(none, alpha), 1);
    EXPECT_EQ(measure::volumePicture(none, none), std::nullopt);
    measure::Plane half = alpha;
    for (float& value : half.values) value /= 2;
    EXPECT_NEAR(*measure::volumePicture(alpha, half), 0.5, 1e-6);
    EXPECT_NEAR(*measure::volumePicture(half, alpha), 0.5, 1e-6);
}

// A method that reports another volume than it draws is detected.

/// A method that draws one cloud and reports another, compared with the ground truth of a third.
class FakeMethod {
 public:
    [[nodiscard]] RunMetrics evaluated(const Puffs& drawnCloud, const Puffs& reportedCloud,
                                       const Puffs& exactCloud) const {
        DrawnMoment drawn;
        drawn.scene = {view_.width, view_.height, std::vector<glm::vec4>(pixels(), {0.2f, 0.4f, 0.8f, 1})};
        drawn.sceneDepth.assign(pixels(), 0);
        drawn.layer = renderParticles(drawnCloud, view_, skyDistances(view_)).image;
        drawn.layerWithoutScene = drawn.layer;
        exports::CollectedVolume volume, reference;
        volume.puffs(reportedCloud);
        reference.puffs(exactCloud);
        RunMetrics runMetrics;
        ReferenceStore none;
        for (const std::int64_t frame : {0, 1}) {
            runMetrics.frames.push_back(
                evaluateMoment(drawn, exactMoment({}, view_, drawn, exactCloud, true, exactCloud, none),
                               {1, volume, reference, view_, 1})
                    .metrics);
            runMetrics.frames.back().frame = frame;
        }
        return runMetrics;
    }

 private:
    [[nodiscard]] std::size_t pixels() const { return static_cast<std::size_t>(view_.width * view_.height); }
    scene::View view_ = test::viewFrom({0, 1, 12}, {0, 1, 0}, 48, 36);
};

double columnOf(const RunMetrics& runMetrics, std::string_view name) {
    for (const auto& [column, value] : summaryOf(runMetrics))
        if (column == name) return value;
    return -1;
}

TEST(ReportedVolume, OfAnotherCloudThanTheDrawnOneIsFlagged) {
    const FakeMethod method;
    MemoryLedger ledger;
    for (const std::uint64_t seed : {1, 2, 3}) {
        const auto cloud = test::ball(ledger, seed, 40, {-2, 1, 0}, 1.5f, 0.5f);
        const auto other = test::ball(ledger, seed, 40, {3, 1, 0}, 1.5f, 0.5f);
        // Reports the volume that it draws, whether its picture is right or wrong.
        for (const auto* exact : {&cloud, &other}) {
            const RunMetrics honest = method.evaluated(cloud, cloud, *exact);
            EXPECT_LT(columnOf(honest, "volume_picture"), 1e-6);
            EXPECT_EQ(volumeWarning(honest), "");
        }
        // Reports the reference itself and draws something else: volume_error alone is perfect.
        const RunMetrics lying = method.evaluated(other, cloud, cloud);
        EXPECT_EQ(columnOf(lying, "volume_error"), 0);
        EXPECT_GT(columnOf(lying, "volume_picture"), 1);
        EXPECT_THAT(volumeWarning(lying), testing::HasSubstr("does not draw the volume that it reports"));
    }
}

TEST(ReportedVolume, ThatIsDrawnAtAThirdOfItsDepthIsFlagged) {
    const FakeMethod method;
    MemoryLedger ledger;
    const auto cloud = test::ball(ledger, 5, 40, {0, 1, 0}, 2, 0.3f);
    auto thin = test::ball(ledger, 5, 40, {0, 1, 0}, 2, 0.3f);
    for (std::size_t i = 0; i < thin.size(); ++i) thin.opacity[i] = -std::expm1(std::log1p(-thin.opacity[i]) / 3);
    EXPECT_NE(volumeWarning(method.evaluated(thin, cloud, cloud)), "");
    EXPECT_EQ(volumeWarning(method.evaluated(thin, thin, cloud)), "");
}

}  // namespace
}  // namespace dustbench::reference
