// What a suite file may say: of the error of pictures (which of them are compared, which are kept, which chart comes
// first), and of values that are given twice.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "bench/results/run_record.h"
#include "bench/suite/suite.h"
#include "methods/contract/errors.h"

namespace dustbench::suite {
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
        results::RunSpec withPictures = cell.spec;
        withPictures.metricPlan->keepsPictures = true;
        EXPECT_NE(results::runId(withPictures), results::runId(cell.spec));
        EXPECT_EQ(results::runId(results::specFromJson(results::specToJson(cell.spec))), results::runId(cell.spec));
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

TEST(GivenTwice, IsRefusedInWhateverForm) {
    const std::string billboard = "methods = [\"billboard\"]\n";
    EXPECT_THAT(faultOf("methods = [\"billboard\", \"null_method\", \"billboard\"]"),
                HasSubstr("s.toml:1: key 'methods': billboard is given twice"));
    EXPECT_THAT(faultOf(billboard + "sizes = [\"64x48\", \"80x60\", \"64x48\"]"),
                HasSubstr("s.toml:2: key 'sizes': 64x48 is given twice"));
    EXPECT_THAT(faultOf(billboard + "scenes = [\"plain\", \"plain\"]"), HasSubstr("plain is given twice"));
    EXPECT_THAT(faultOf(billboard + "drives = [\"straight\", \"straight\"]"), HasSubstr("straight is given twice"));
    const auto values = [&](const std::string& list) {
        return faultOf(billboard + "[parameters]\nparticles = [" + list + "]");
    };
    EXPECT_THAT(values("200, 400, 200"), HasSubstr("s.toml:3: parameter particles: 200 is given twice"));
    for (const char* form : {"\"100\"", "100.0", "\"100:300:100\""})
        EXPECT_THAT(values(std::string("100, ") + form), HasSubstr("is given twice")) << form;
    EXPECT_THAT(faultOf(billboard + "[method.billboard]\npreroll = [1, 1.0]"), HasSubstr("is given twice"));
    EXPECT_EQ(values("100, 101, 200"), "nothing thrown");
}

}  // namespace
}  // namespace dustbench::suite
