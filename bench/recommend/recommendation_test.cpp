#include "bench/recommend/recommendation.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <string>

#include "bench/recommend/test_table.h"
#include "methods/contract/errors.h"
#include "source_folder.h"

namespace dustbench::recommend {
namespace {

TEST(Budget, IsATimeWithItsUnit) {
    EXPECT_DOUBLE_EQ(parseBudget("--budget", "4ms").ms, 4);
    EXPECT_DOUBLE_EQ(parseBudget("--budget", "4 ms").ms, 4);
    EXPECT_DOUBLE_EQ(parseBudget("--budget", "0.25ms").ms, 0.25);
}

TEST(Budget, OfARateIsTheWholeFrame) {
    EXPECT_DOUBLE_EQ(parseBudget("--budget", "50fps").ms, 20);
    EXPECT_DOUBLE_EQ(parseBudget("--budget", "50 fps").ms, 20);
}

TEST(Budget, ThatIsNoneIsRefusedByName) {
    for (const char* text : {"", "4", "ms", "-4ms", "0ms", "0fps", "4s", "4 ms ms", "nanms", "1e9ms", "4,5ms"}) try {
            (void)parseBudget("--budget", text);
            ADD_FAILURE() << text;
        } catch (const InputError& error) {
            EXPECT_THAT(error.what(), testing::StartsWith(std::string("--budget: got '") + text + "', allowed:"));
        }
}

using testing::ElementsAre;
using testing::HasSubstr;
using testing::SizeIs;

const measure::Metric psnr = qualityMetric("", "psnr_mask_db");

Rankings rank(const std::vector<TestRow>& rows) {
    return rankSettings(runsOf(rows), psnr);
}

/// The answer at a budget, such as `a`, or `none`.
std::string answerAt(const std::vector<TestRow>& rows, double budgetMs) {
    const Rankings rankings = rank(rows);
    if (rankings.rankings.size() != 1) return fmt::format("{} rankings", rankings.rankings.size());
    const auto answer = recommend(rankings.rankings.front(), psnr, budgetMs).recommended;
    return answer ? rankings.rankings.front().settings[*answer].method : "none";
}

/// Adds a run with metrics but without times for each of these values, each with its own seed.
void addPictures(std::vector<TestRow>& rows, const std::string& method, const std::vector<double>& decibels) {
    int seed = 0;
    for (const double value : decibels)
        rows.push_back({.method = method, .ms = "", .psnr = fmt::format("{}", value), .seed = ++seed});
}

TEST(Recommendation, FitsByTheUpperEndOfTheInterval) {
    std::vector<TestRow> rows;
    add(rows, "good", {3, 3, 3, 3, 3, 4.5}, "40");
    add(rows, "plain", {1, 1, 1, 1, 1, 2}, "30");
    EXPECT_EQ(answerAt(rows, 4.5), "good");
    EXPECT_EQ(answerAt(rows, 4.4), "plain");
    EXPECT_EQ(answerAt(rows, 2), "plain");
    EXPECT_EQ(answerAt(rows, 1.9), "none");
}

TEST(Recommendation, OfEquallyGoodPicturesIsTheFastest) {
    std::vector<TestRow> rows;
    add(rows, "lead", {3, 3, 3, 3, 3, 3}, "");
    add(rows, "near", {2, 2, 2, 2, 2, 2}, "");
    add(rows, "far", {1, 1, 1, 1, 1, 1}, "");
    addPictures(rows, "lead", {38, 39, 40, 41, 42});
    addPictures(rows, "near", {35, 36, 37, 38, 38.5});  // its highest is above the lowest of the leader
    addPictures(rows, "far", {33, 34, 35, 36, 37});     // overlaps `near`, not the leader
    EXPECT_EQ(answerAt(rows, 4), "near");
    const Rankings rankings = rank(rows);
    const Recommendation answer = recommend(rankings.rankings.front(), psnr, 4);
    EXPECT_THAT(answer.equallyGood, ElementsAre(0));
    EXPECT_EQ(answerAt(rows, 2.5), "far") << "without the leader, `near` leads, and `far` overlaps it";
}

TEST(Recommendation, WithoutOneNamesTheCheapest) {
    std::vector<TestRow> rows;
    add(rows, "slow", {9, 9, 9}, "40");
    add(rows, "fast", {5, 5, 6}, "30");
    const Rankings rankings = rank(rows);
    const Recommendation answer = recommend(rankings.rankings.front(), psnr, 1);
    EXPECT_FALSE(answer.recommended);
    EXPECT_EQ(rankings.rankings.front().settings[answer.cheapest].method, "fast");
}

TEST(Recommendation, NamesTheBetterPictureBeyondTheBudget) {
    std::vector<TestRow> rows;
    add(rows, "slow", {9, 9, 9}, "40");
    add(rows, "fast", {5, 5, 6}, "30");
    const Rankings rankings = rank(rows);
    EXPECT_EQ(recommend(rankings.rankings.front(), psnr, 6).betterBeyond, 0U);
    EXPECT_FALSE(recommend(rankings.rankings.front(), psnr, 10).betterBeyond);
}

TEST(Recommendation, IsByTheLowestFlipIfAsked) {
    std::vector<TestRow> rows;
    add(rows, "a", {1, 1, 1}, "40");
    add(rows, "b", {1, 1, 1}, "30");
    MeasuredRuns runs = runsOf(rows);
    for (MeasuredRun& run : runs.runs)
        if (run.numbers.contains("psnr_mask_db")) run.numbers["flip_mask"] = run.method == "a" ? 0.2 : 0.1;
    const measure::Metric flip = qualityMetric("--quality", "flip_mask");
    const Rankings rankings = rankSettings(runs, flip);
    const Recommendation answer = recommend(rankings.rankings.at(0), flip, 4);
    EXPECT_EQ(rankings.rankings.at(0).settings.at(*answer.recommended).method, "b");
}

TEST(Recommendation, OfAPictureThatEqualsTheReferenceLeads) {
    std::vector<TestRow> rows;
    add(rows, "good", {1, 1, 1}, "90");
    add(rows, "exact", {2, 2, 2}, "99");
    std::string text = tableOf(rows);
    text.replace(text.find(",99,"), 4, ",,");  // identical within the mask: the column is empty
    const Rankings rankings =
        rankSettings(measuredRuns(files::CsvTable::parseText(text, "summary.csv"), "summary.csv"), psnr);
    const Recommendation answer = recommend(rankings.rankings.at(0), psnr, 4);
    EXPECT_EQ(rankings.rankings.at(0).settings.at(*answer.recommended).method, "exact");
}

constexpr const char* sample = DUSTBENCH_SOURCE_DIR "/reports/sample/carr2006";

/// The committed sample: its medians of octrees are 0.4 to 1.5 ms, those of the better billboards 0.9 and 3.5 ms.
class Sample : public testing::Test {
 protected:
    static std::vector<std::string> answersAt(double budgetMs) {
        MeasuredRuns runs = readMeasuredRuns(sample);
        const Rankings rankings = rankSettings(runs, psnr);
        std::vector<std::string> answers;
        for (const Ranking& ranking : rankings.rankings) {
            const auto answer = recommend(ranking, psnr, budgetMs).recommended;
            answers.push_back(ranking.world.at("particles") + " " +
                              (answer ? ranking.settings[*answer].method.substr(0, 6) : "none"));
        }
        return answers;
    }
};

TEST_F(Sample, AnswersThreeBudgets) {
    EXPECT_THAT(answersAt(0.1), ElementsAre("500 none", "2000 none"));
    EXPECT_THAT(answersAt(3), ElementsAre("500 billbo", "2000 octree"));
    EXPECT_THAT(answersAt(100), ElementsAre("500 billbo", "2000 billbo"));
}

TEST_F(Sample, SaysWhatItWasMeasuredOn) {
    const MeasuredRuns runs = readMeasuredRuns(sample);
    ASSERT_THAT(runs.machines, SizeIs(1));
    EXPECT_THAT(runs.machines.front().fields.at("gl_renderer"), HasSubstr("llvmpipe"));
    EXPECT_THAT(runs.machines.front().commits, SizeIs(1));
}

/// The committed sample of transparency: haze, a cloud and dense smoke.
TEST(TransparencySample, AnswersOverEveryMethodFromHazeToDenseSmoke) {
    const Rankings rankings = rankSettings(readMeasuredRuns(DUSTBENCH_SOURCE_DIR "/reports/sample/transparency"), psnr);
    for (const char* particles : {"20", "100", "700"}) {
        std::size_t methods = 0;
        for (const Ranking& ranking : rankings.rankings) {
            if (ranking.world.at("scene") != "smoke" || ranking.world.at("particles") != particles) continue;
            std::set<std::string> ranked;
            for (const MeasuredSetting& setting : ranking.settings) ranked.insert(setting.method);
            methods = std::max(methods, ranked.size());
            EXPECT_TRUE(recommend(ranking, psnr, 1e6).recommended) << particles;
        }
        EXPECT_EQ(methods, 9u) << particles;
    }
}

}  // namespace
}  // namespace dustbench::recommend
