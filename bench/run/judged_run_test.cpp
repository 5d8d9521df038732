// Metrics of whole runs with flaws, at the lowest level at which the flaws can be detected.
#include "bench/run/judged_run.h"

#include <gmock/gmock.h>

#include <map>

#include "bench/suite/suite.h"
#include "methods/contract/registry.h"
#include "methods/kit/files/csv.h"
#include "methods/kit/files/whole_text.h"
#include "methods/kit/testing/test_folder.h"

namespace dustbench::run {
namespace {

class EvaluatedRun : public testing::Test {
 protected:
    /// The summary of a run with metrics and this many frames.
    std::map<std::string, double> evaluated(const std::string& method, const results::ParameterTexts& parameters,
                                            std::int64_t frames = 31, const std::string& drive = "straight",
                                            const results::ParameterTexts& finer = {},
                                            const std::string& scene = "plain") {
        results::RunSpec spec;
        spec.method = method;
        spec.scene = scene;
        spec.drive = drive;
        spec.size = {160, 120};
        spec.frames = frames;
        spec.warmup = 2;
        spec.parameters = results::canonicalParameters(findMethod(method), parameters);
        spec.metricPlan.emplace().finer = finer;
        std::map<std::string, double> numbers;
        const results::RunRecord record = measureRun(
            spec, folder_.path(), {}, [](std::string_view, std::int64_t, std::int64_t) {}, references_);
        for (const auto& [name, value] : record.summary) {
            if (const auto* number = std::get_if<double>(&value)) numbers[name] = *number;
            if (const auto* number = std::get_if<std::int64_t>(&value)) numbers[name] = static_cast<double>(*number);
        }
        return numbers;
    }
    [[nodiscard]] static bool hasMethod(std::string_view id) {
        return std::ranges::any_of(methods(), [id](const MethodInfo& info) { return info.id == id; });
    }

    TestFolder folder_;
    std::filesystem::path references_;  ///< shared by runs; empty: none
};

TEST_F(EvaluatedRun, SoftBillboardsAreTheExactPictureAndHardOnesAreCutOff) {
    if (!hasMethod("billboard")) GTEST_SKIP() << "no billboards here";
    auto soft = evaluated("billboard", {{"soft", "on"}, {"particles", "600"}});
    auto hard = evaluated("billboard", {{"soft", "off"}, {"particles", "600"}});
    EXPECT_GT(soft.at("psnr_db"), 60);
    EXPECT_LT(soft.at("popping"), 0.001);
    EXPECT_LT(hard.at("psnr_db"), soft.at("psnr_db") - 10);
    EXPECT_GT(hard.at("cutoff"), 5 * soft.at("cutoff"));
    EXPECT_EQ(soft.at("volume_error"), 0);
    EXPECT_GT(soft.at("quads_per_pixel"), 0);
}

TEST_F(EvaluatedRun, IsTheSameWithReferencesOfAnotherRun) {
    if (!hasMethod("billboard") || !hasMethod("null_method")) GTEST_SKIP() << "no billboards here";
    const auto metrics = [&](const char* method) {
        (void)evaluated(method, {{"particles", "300"}}, 7);
        return files::wholeText(folder_.path() / "metrics.csv", "metrics");
    };
    const auto images = [&] {
        return std::distance(std::filesystem::directory_iterator(references_), std::filesystem::directory_iterator());
    };
    const std::string alone = metrics("billboard");
    references_ = folder_.path() / "references";
    (void)metrics("null_method");
    const auto ofFirst = images();
    EXPECT_GT(ofFirst, 0);
    EXPECT_EQ(metrics("billboard"), alone);
    EXPECT_EQ(images(), ofFirst) << "the second run needs no image that the first has not stored";
}

TEST_F(EvaluatedRun, LitDustIsJudgedByItsLightAndItsGapsStayAsTheyAre) {
    if (!hasMethod("exact_tiles") || !hasMethod("null_method")) GTEST_SKIP() << "no exact tiles here";
    const auto of = [&](const char* method, const char* light) {
        return evaluated(method, {{"light", light}, {"particles", "600"}}, 5);
    };
    const auto unlit = of("exact_tiles", "none"), lit = of("exact_tiles", "sun"), nothing = of("null_method", "sun");
    EXPECT_EQ(lit.at("gaps"), unlit.at("gaps"));
    EXPECT_TRUE(unlit.contains("psnr_continuum_db"));
    EXPECT_FALSE(lit.contains("psnr_continuum_db"));
    // The remaining difference: puffs are lit as a whole, not point by point.
    EXPECT_GT(lit.at("psnr_mask_db"), 35);
    EXPECT_LT(lit.at("psnr_mask_db"), 60);
    EXPECT_LT(nothing.at("psnr_mask_db"), lit.at("psnr_mask_db") - 15);
}

TEST_F(EvaluatedRun, DustOfTwoSoilsNeedsOrder) {
    if (!hasMethod("weighted_oit") || !hasMethod("moment_oit") || !hasMethod("exact_tiles"))
        GTEST_SKIP() << "no OIT here";
    const auto of = [&](const char* method) {
        return evaluated(method, {{"particles", "600"}}, 5, "straight", {}, "two_soils").at("psnr_mask_db");
    };
    const double weighted = of("weighted_oit"), moments = of("moment_oit"), exact = of("exact_tiles");
    EXPECT_LT(weighted, 52);
    EXPECT_GT(moments, weighted + 8);
    EXPECT_GT(exact, moments + 30);
}

TEST_F(EvaluatedRun, GapsOfBillboardsRiseWithSpeed) {
    if (!hasMethod("billboard")) GTEST_SKIP() << "no billboards here";
    std::vector<double> gaps;
    for (const char* speed : {"5", "15", "40"})
        gaps.push_back(evaluated("billboard", {{"speed", speed}, {"particles", "600"}, {"soft", "on"}}, 5).at("gaps"));
    EXPECT_LT(gaps[0], gaps[1]);
    EXPECT_LT(gaps[1], gaps[2]);
}

TEST_F(EvaluatedRun, VoxelsPopAndCrossFadingPopsLess) {
    if (!hasMethod("octree_search") || !hasMethod("billboard")) GTEST_SKIP() << "no octree here";
    const results::ParameterTexts world{{"particles", "600"}};
    const auto with = [&](const char* name, const char* value) {
        results::ParameterTexts texts = world;
        texts[name] = value;
        return texts;
    };
    const double soft = evaluated("billboard", with("soft", "on")).at("popping");
    const double plain = evaluated("octree_search", with("crossfade", "off")).at("popping");
    const double faded = evaluated("octree_search", with("crossfade", "on")).at("popping");
    EXPECT_LT(faded, plain);
    EXPECT_LT(soft, 0.1 * faded);
}

TEST_F(EvaluatedRun, HoldsAMethodAgainstItselfAtAFinerSetting) {
    if (!hasMethod("octree_search")) GTEST_SKIP() << "no octree here";
    const results::ParameterTexts coarse{{"particles", "300"}, {"depth", "7"}, {"policy", "accumulate"}};
    const auto self = evaluated("octree_search", coarse, 5, "straight", {{"depth", "7"}});
    EXPECT_EQ(self.at("identical"), 1);
    EXPECT_EQ(self.at("volume_error"), 0);
    EXPECT_EQ(self.at("gaps"), 0);
    const auto finer = evaluated("octree_search", coarse, 5, "straight", {{"depth", "9"}});
    EXPECT_EQ(finer.at("identical"), 0);
    EXPECT_GT(finer.at("volume_error"), 0.1);
}

TEST_F(EvaluatedRun, LeavesARowAndThePicturesOfEachJudgedFrame) {
    const std::string method = methods().front().id;
    const auto numbers = evaluated(method, {{"particles", "100"}}, 33);
    const auto table = files::CsvTable::parseFile(folder_.path() / "metrics.csv");
    ASSERT_EQ(table.rows(), 32u);  // moments 0, 8, 16, 24, 32, and the last 31: 2 to 32
    EXPECT_EQ(table.cell(0, "frame"), "0");
    EXPECT_EQ(table.cell(1, "frame"), "2");
    double sum = 0;
    for (std::size_t row = 0; row < table.rows(); ++row)
        if (!table.cell(row, "rmse_linear").empty()) sum += table.number(row, "rmse_linear");
    EXPECT_NEAR(numbers.at("rmse_linear"), sum / 5, 1e-12);
    for (const char* frame : {"f000000", "f000008", "f000032"})
        for (const char* file : {".png", ".exr", "_reference.png", "_reference.exr", "_difference.png"})
            EXPECT_TRUE(std::filesystem::exists(folder_.path() / "images" / (std::string(frame) + file)))
                << frame << file;
}

TEST_F(EvaluatedRun, HasNoPoppingInAShortRunAndNoMetricsWithoutDust) {
    const std::string method = methods().front().id;
    EXPECT_FALSE(evaluated(method, {{"particles", "100"}}, 30).contains("popping"));
    const auto empty = evaluated(method, {{"preroll", "0"}}, 31, "stop_and_go");  // the vehicle stands at first
    for (const char* name :
         {"popping", "gaps", "spill", "components", "cutoff", "self_similarity", "quads_per_pixel", "psnr_db",
          "psnr_mask_db", "ssim_mask", "flip_mask", "rmse_linear_mask", "error_max", "banding"})
        EXPECT_FALSE(empty.contains(name)) << name;
    EXPECT_EQ(empty.at("identical"), 1);
    EXPECT_EQ(empty.at("ssim"), 1);
}

}  // namespace
}  // namespace dustbench::run
