// What a suite says of the error of pictures: which of them are compared, which are kept, which chart comes first.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "bench/results/run_record.h"
#include "bench/suite/suite.h"
#include "methods/contract/errors.h"

namespace dustbench::bench {
namespace {

using testing::AllOf;
using testing::HasSubstr;

std::string faultOf(const std::string& text) {
    try {
        (void)parseSuite(text, "s.toml", false);
    } catch (const InputError& error) {
        return error.what();
    }
    return "nothing thrown";
}

TEST(SuiteMetrics, LeavesMetricsOutAlone) {
    const std::string text =
        "methods = [\"null_method\"]\nsizes = [\"64x48\", \"128x96\"]\nmetrics = true\nmetric_pictures = false\n"
        "[parameters]\nwork = [0, 1]\n[[except]]\nonly = \"metrics\"\nsizes = [\"128x96\"]\n"
        "[[except]]\nonly = \"metrics\"\n[except.parameters]\nwork = 1\n";
    const Suite suite = parseSuite(text, "s.toml", false);
    EXPECT_EQ(suite.cells.size(), 4u);
    for (const PlannedRun& cell : suite.cells) {
        EXPECT_EQ(cell.spec.metricPlan.has_value(),
                  cell.spec.size.width == 64 && cell.spec.parameters.at("work") == "0");
        EXPECT_EQ(cell.skip, "");
        if (!cell.spec.metricPlan) continue;
        EXPECT_FALSE(cell.spec.metricPlan->keepsPictures);
        RunSpec withPictures = cell.spec;
        withPictures.metricPlan->keepsPictures = true;
        EXPECT_NE(runId(withPictures), runId(cell.spec));
        EXPECT_EQ(runId(specFromJson(specToJson(cell.spec))), runId(cell.spec));
    }
    EXPECT_THAT(faultOf("[[except]]\nonly = \"metrics\"\n"), HasSubstr("matches no configuration"));
    EXPECT_THAT(faultOf("metrics = true\n[[except]]\nonly = \"metrics\"\nreason = \"late\"\n"),
                AllOf(HasSubstr("s.toml:3"), HasSubstr("not allowed with 'reason'")));
    EXPECT_THAT(faultOf("metrics = true\n[[except]]\nonly = \"times\"\n"), HasSubstr("'times'"));
    EXPECT_THAT(faultOf("metric_pictures = false\n"), HasSubstr("requires 'metrics"));
}

TEST(SuiteMetrics, AChartMayBeOfErrorAgainstCost) {
    const Suite suite =
        parseSuite("methods = [\"null_method\"]\nchart = \"flip against method_ms_median\"\n", "s", false);
    EXPECT_EQ(suite.chart.column, "flip");
    EXPECT_EQ(suite.chart.against, "method_ms_median");
    EXPECT_THAT(faultOf("chart = \"flip against fps_avg\"\n"), HasSubstr("fps_avg"));
}

}  // namespace
}  // namespace dustbench::bench
