// Forecasts of durations: arithmetic, comparison of a started run with the complete one, and a plan with scripts as
// children.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <map>

#include "bench/run/measured_run.h"
#include "bench/run/plan_forecast.h"
#include "bench/run/run_forecast.h"
#include "bench/suite/suite.h"
#include "methods/contract/registry.h"
#include "methods/kit/testing/test_folder.h"

namespace dustbench::run {
namespace {

using testing::HasSubstr;

TEST(RunForecast, CountsEveryFrameOnceForWhatItNeeds) {
    results::RunSpec spec;
    spec.warmup = 10;
    spec.frames = 100;
    const FramesBegun frames{.untilFrames = 2, .perFrame = 0.1};
    const MetricsBegun metrics{.untilFrames = 3, .perPlainFrame = 0.01, .perMoment = 5, .perStretchFrame = 1};
    EXPECT_DOUBLE_EQ(extrapolate(spec, frames, metrics).seconds(), 2 + 110 * 0.1);
    spec.metricPlan.emplace();
    // Five moments, 0, 24, 49, 74 and 99; the stretch is 69 … 99, of which two are moments.
    const RunForecast forecast = extrapolate(spec, frames, metrics);
    EXPECT_DOUBLE_EQ(forecast.measuring, 2 + 110 * 0.1);
    EXPECT_DOUBLE_EQ(forecast.metricPlan, 3 + 5 * 5 + 29 * 1 + (110 - 5 - 29) * 0.01);
    spec.frames = 20;  // too few for a stretch
    EXPECT_DOUBLE_EQ(extrapolate(spec, frames, metrics).metricPlan, 3 + 5 * 5 + (30 - 5) * 0.01);
}

TEST(RunForecast, BeginsEveryKindOfFrame) {
    // One method with the ground truth as its reference, and one that needs a finer setting of itself, which is
    // missing here.
    std::map<bool, const MethodInfo*> kinds;
    for (const MethodInfo& info : methods())
        kinds.emplace(info.create(results::resolveParameters(info, {}).method)->stateHash().has_value(), &info);
    for (const auto& [hasOwnState, info] : kinds) {
        results::RunSpec spec;
        spec.method = info->id;
        spec.size = {64, 48};
        spec.warmup = 1;
        spec.frames = 40;
        spec.parameters = results::canonicalParameters(*info, {{"particles", "50"}, {"preroll", "0.2"}});
        spec.metricPlan.emplace();
        const TestFolder folder;
        const RunForecast forecast = forecastRun(spec, folder.path());
        EXPECT_GT(forecast.measuring, 0) << info->id;
        EXPECT_EQ(forecast.metricPlan > 0, !hasOwnState) << info->id;
    }
}

TEST(ForecastByCell, MetricsCountForTheRunThatHasThem) {
    suite::PlannedRun cell;
    cell.spec.method = "haze";
    cell.spec.metricPlan.emplace();
    suite::Suite suite;
    suite.cells = {cell};
    suite.repetitions = 3;
    const std::vector<suite::PlannedRun> plan = suite::planRuns(suite);
    ForecastByCell forecasts;
    EXPECT_LT(forecasts.seconds(plan[0].spec), 0);
    forecasts.set(plan[0].spec, {10, 90});
    EXPECT_DOUBLE_EQ(forecasts.seconds(plan[0].spec), 100);
    EXPECT_DOUBLE_EQ(forecasts.seconds(plan[2].spec), 10);

    const std::vector<const suite::PlannedRun*> toDo{&plan[0], &plan[1], &plan[2]};
    RemainingTime remaining(toDo, forecasts, 4);
    EXPECT_DOUBLE_EQ(remaining.seconds(), 100 + 4 + 10 + 4 + 10);
    remaining.ended(0, 120);
    EXPECT_DOUBLE_EQ(remaining.seconds(), 28);
    remaining.ended(1, 20);  // measured times take precedence over forecasts
    EXPECT_DOUBLE_EQ(remaining.seconds(), 20);
}

/// Three configurations of two seeds; the children are shell scripts.
class PlanForecasts : public testing::Test {
 protected:
    PlanForecasts() : results_(folder_.path()) {
        suite::Suite suite;
        for (int cell = 0; cell < 3; ++cell)
            for (const std::uint64_t seed : {1, 2}) {
                suite::PlannedRun& run = suite.cells.emplace_back();
                run.spec.method = "haze";
                run.spec.frames = 100 + cell;
                run.spec.seed = seed;
                run.label = "cell=" + std::to_string(cell);
            }
        plan_ = suite::planRuns(suite);
    }
    /// `script` sees the specification's file as $1.
    PlanForecast forecast(const std::string& script) {
        options_.forecastCommand = [script](const std::filesystem::path& spec, const std::filesystem::path&) {
            return std::vector<std::string>{"/bin/sh", "-c", script, "sh", spec.string()};
        };
        return forecastPlan(plan_, results_, options_, quiet_);
    }

    TestFolder folder_;
    results::ResultsFolder results_;
    std::vector<suite::PlannedRun> plan_;
    ExecutionOptions options_;
    ExecutionListener quiet_;
};

TEST_F(PlanForecasts, OneRunOfEachCellIsBegunAndAllAreCounted) {
    const PlanForecast all = forecast("echo x >> " + (folder_.path() / "begun").string() + "; echo forecast 5 0");
    EXPECT_EQ(all.runs, 6u);
    EXPECT_DOUBLE_EQ(all.seconds, 30);
    EXPECT_TRUE(all.warnings.empty());
    EXPECT_EQ(std::filesystem::file_size(folder_.path() / "begun"), 3 * 2u);
    EXPECT_TRUE(std::filesystem::is_empty(folder_.path() / "runs")) << "a run that was only started left files";
}

TEST_F(PlanForecasts, AFailureAndARunThatTakesTooLongAreNamed) {
    options_.timeoutSeconds = 100;
    const PlanForecast all = forecast(
        "case $(cat $1) in *'\"frames\": 101'*) echo 'no such thing' >&2; exit 3;; "
        "*'\"frames\": 102'*) echo forecast 70 80;; *) echo forecast 5 0;; esac");
    ASSERT_EQ(all.warnings.size(), 2u);
    const std::string warnings = all.warnings[0] + all.warnings[1];
    EXPECT_THAT(warnings, HasSubstr("haze plain cell=1: exit code 3: no such thing"));
    EXPECT_THAT(warnings, HasSubstr("haze plain cell=2: will take 2 min 30 s, allowed: 1 min 40 s"));
    EXPECT_GE(all.seconds, 2 * (5 + 70));
    EXPECT_LT(all.seconds, 2 * (5 + 70) + 20);
}

TEST_F(PlanForecasts, AnInterruptionEndsIt) {
    options_.interrupted = [] { return true; };
    EXPECT_TRUE(forecast("sleep 60").aborted);
}

}  // namespace
}  // namespace dustbench::run
