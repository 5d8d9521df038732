// A method that reports another volume than it draws is detected.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "bench/measure/image/volume_error.h"
#include "bench/reference/judge/judgement.h"
#include "bench/reference/particle_image.h"
#include "bench/reference/test_clouds.h"

namespace dustbench::bench {
namespace {

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
        CollectedVolume volume, reference;
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
}  // namespace dustbench::bench
