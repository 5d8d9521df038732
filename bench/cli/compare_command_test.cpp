// End-to-end tests of `compare`.
#include <gmock/gmock.h>

#include <fstream>

#include "bench/cli/called_program.h"
#include "bench/results/compared_runs.h"
#include "methods/kit/files/csv.h"
#include "methods/kit/pictures/image.h"

namespace dustbench::cli {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

class CompareCommand : public Dustbench {
 protected:
    void SetUp() override {
        Dustbench::SetUp();
        if (std::ranges::none_of(methods(), [](const MethodInfo& info) { return info.id == "billboard"; }))
            GTEST_SKIP() << "no billboards here";
        if (!bench::findBaseline()) GTEST_SKIP() << "no null method here";
    }
    [[nodiscard]] Called compare(const std::string& more) const {
        return call(fmt::format("compare --out '{}' {}", out(), more));
    }
};

TEST_F(CompareCommand, WritesMetricsSummaryAndContactSheetAndGoesOnWhereItWas) {
    const std::string both =
        "billboard billboard:soft=true --size 96x72 --frames 6 --warmup 1 --repetitions 2 -P preroll=0.3 "
        "-P particles=200";
    const Called first = compare(both);
    ASSERT_EQ(first.code, 0) << first.err;
    EXPECT_THAT(first.out, AllOf(HasSubstr("psnr_db"), HasSubstr("billboard soft=on"), HasSubstr("UNRESOLVED")));
    const auto summary = files::CsvTable::parseFile(fs::path(out()) / "summary.csv");
    ASSERT_EQ(summary.rows(), 6u);
    for (std::size_t row = 0; row < 6; ++row) {
        const bool isNull = summary.cell(row, "method") == bench::baselineMethod;
        EXPECT_EQ(summary.cell(row, "flip").empty(), isNull || summary.cell(row, "repetition") != "1");
        EXPECT_EQ(summary.cell(row, "method_ms_median").empty(), isNull);
    }
    const pictures::Image sheet = pictures::readImage(fs::path(out()) / "contact_sheet.png");
    EXPECT_GT(sheet.width, 5 * 400);
    EXPECT_GT(sheet.height, 5 * 300);

    const Called again = compare(both);
    EXPECT_EQ(again.code, 0);
    EXPECT_THAT(again.err, HasSubstr("6 existing"));
    EXPECT_EQ(again.out, first.out);
}

TEST_F(CompareCommand, LeavesTheSvgAndSaysWhyWhereNothingDrawsIt) {
    const char* const path = std::getenv("PATH");
    const std::string before = path ? path : "";
    setenv("PATH", folder_.c_str(), 1);
    const Called called = compare(
        "billboard billboard:soft=true --size 96x72 --frames 6 --warmup 1 --repetitions 1 -P preroll=0.1 "
        "-P particles=50");
    setenv("PATH", before.c_str(), 1);
    EXPECT_EQ(called.code, 0) << called.err;
    EXPECT_THAT(called.out, AllOf(HasSubstr("contact_sheet.svg"), HasSubstr("no contact_sheet.png: "),
                                  HasSubstr("'rsvg-convert', which is not installed")));
    EXPECT_TRUE(fs::exists(fs::path(out()) / "contact_sheet.svg"));
    EXPECT_FALSE(fs::exists(fs::path(out()) / "contact_sheet.png"));
}

TEST_F(CompareCommand, ShowsAMethodWithASimulationOfItsOwnBesideTheJudged) {
    if (std::ranges::none_of(methods(), [](const MethodInfo& info) { return info.id == "grid_fluid"; }))
        GTEST_SKIP() << "no fluid here";
    const Called called = compare(
        "grid_fluid:grid=16x8x8 billboard --size 96x72 --frames 6 --warmup 1 --repetitions 1 -P preroll=0.1 "
        "-P particles=50");
    ASSERT_EQ(called.code, 0) << called.err;
    const pictures::Image sheet = pictures::readImage(fs::path(out()) / "contact_sheet.png");
    // The reference image, both methods, and the difference of one.
    EXPECT_GT(sheet.width, 4 * 400);
    EXPECT_LT(sheet.width, 5 * 400);
    const auto summary = files::CsvTable::parseFile(fs::path(out()) / "summary.csv");
    ASSERT_EQ(summary.rows(), 3u);
    for (std::size_t row = 0; row < 3; ++row)
        EXPECT_TRUE(fs::exists(fs::path(out()) / summary.cell(row, "FILE_image")));
}

TEST_F(CompareCommand, TurnsTheSheetOfManyMethods) {
    const Called called = compare(
        "billboard billboard:soft=true billboard:mode=paper null_method null_method:work=1 --size 96x72 --frames 5 "
        "--warmup 1 --repetitions 1 -P preroll=0.1 -P particles=50");
    ASSERT_EQ(called.code, 0) << called.err;
    const pictures::Image sheet = pictures::readImage(fs::path(out()) / "contact_sheet.png");
    // Five moments of the reference image and of five methods, with their differences.
    EXPECT_GT(sheet.width, 10 * 400);
    EXPECT_LT(sheet.width, 11 * 400 + 160);
    EXPECT_GT(sheet.height, 6 * 300);
    std::ifstream file(fs::path(out()) / "contact_sheet.svg");
    const std::string svg{std::istreambuf_iterator<char>(file), {}};
    for (const char* heading : {">reference<", ">billboard<", ">null_method<", ">difference<"})
        EXPECT_THAT(svg, HasSubstr(heading));
    EXPECT_THAT(svg, Not(HasSubstr("difference of")));
}

TEST_F(CompareCommand, RefusesInOneLine) {
    const auto refused = [&](const std::string& more) {
        const Called called = compare(more);
        EXPECT_EQ(called.code, 3) << more;
        EXPECT_EQ(std::ranges::count(called.err, '\n'), 1) << called.err;
        EXPECT_FALSE(fs::exists(out())) << more;
        return called.err;
    };
    EXPECT_THAT(refused(""), HasSubstr("methods"));
    EXPECT_THAT(refused("billboard"), HasSubstr("2 or more"));
    EXPECT_THAT(refused("billboard billbord"), HasSubstr("did you mean"));
    EXPECT_THAT(refused("billboard a/b"), HasSubstr("billboard' together with a results folder"));
    EXPECT_THAT(refused("billboard billboard:soft=true --moments 0:4"), HasSubstr("got 4 frames (0:4:1)"));
    EXPECT_THAT(refused("billboard billboard:soft=true --moments 0:200:2"), HasSubstr("beyond the run's end"));
    EXPECT_THAT(refused("billboard billboard:soft=true -P particles=1,2"), HasSubstr("got 2 values"));
    EXPECT_THAT(refused("billboard billboard:soft=true --drive nowhere"), HasSubstr("nowhere"));
}

}  // namespace
}  // namespace dustbench::cli
