// The measurement protocol for the shown state. Child processes are shell scripts that copy the files of a run.
#include "bench/view/shown_measurement.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "bench/results/compared_runs.h"
#include "bench/results/summary.h"
#include "bench/view/viewer.h"
#include "methods/contract/registry.h"
#include "methods/kit/testing/test_folder.h"

namespace dustbench::view {
namespace {
namespace fs = std::filesystem;

using ::testing::AllOf;
using ::testing::Contains;
using ::testing::HasSubstr;

class ShownMeasurement : public testing::Test {
 protected:
    void SetUp() override {
        for (const char* id : {"billboard", "octree_search", "null_method"})
            if (std::ranges::none_of(methods(), [id](const MethodInfo& info) { return info.id == id; }))
                GTEST_SKIP() << "no method " << id << " here";
        state_.size = {64, 48};
        state_.world = {{"particles", "300"}, {"preroll", "0.2"}};
        state_.frame = 7;
        state_.a.method = "billboard";
        state_.b = HalfState{"octree_search", {}};
        fs::create_directories(folder_.path() / "made");
    }
    /// Child processes whose runs take `msOf` their method.
    MeasurementHooks children(const suite::Suite& suite, const std::function<double(const results::RunSpec&)>& msOf) {
        for (const suite::PlannedRun& run : suite::planRuns(suite)) {
            results::RunRecord record;
            record.spec = run.spec;
            record.summary = results::identityColumns(record, 2);
            record.summary.emplace_back("frame_ms_median", msOf(run.spec));
            exports::writeWhole(folder_.path() / "made" / results::runId(run.spec), results::toJson(record));
        }
        MeasurementHooks hooks;
        hooks.execution.command = [made = folder_.path() / "made"](const fs::path&, const fs::path& folder) {
            std::string id = folder.filename();
            id = id.substr(id.find('-') + 1);
            return std::vector<std::string>{
                "/bin/sh", "-c", "cp \"$2\" \"$1/run.json\"", "sh", folder.string(), (made / id).string()};
        };
        hooks.between = [this](const std::string& progress) { reported_.push_back(progress); };
        return hooks;
    }
    /// B takes half of A's time, with a scatter of a thousandth.
    static double half(const results::RunSpec& spec) {
        const double scatter = 1 + 1e-3 * spec.repetition;
        if (spec.method == results::baselineMethod) return 1;
        return scatter * (spec.method == "billboard" ? 10 : 5);
    }
    [[nodiscard]] fs::path out() const { return folder_.path() / "out"; }

    TestFolder folder_;
    ViewState state_;
    std::vector<std::string> reported_;
};

TEST_F(ShownMeasurement, IsTheRunsOfTheLinesLongEnough) {
    suite::Suite suite = measurementOf(state_);
    ASSERT_EQ(suite.cells.size(), 2u);
    results::RunSpec expected = runOf(state_, Half::b);
    expected.frames = minimumMeasuredFrames;
    expected.warmup = results::RunSpec().warmup;
    expected.imagesEvery = 0;
    EXPECT_EQ(results::canonicalKey(suite.cells[1].spec), results::canonicalKey(expected));
    state_.frame = 500;
    EXPECT_EQ(measurementOf(state_).cells[0].spec.frames, 501);
    EXPECT_EQ(suite::planRuns(suite).size(), 3u * measuredRepetitions);
    state_.b->method = exactPicture;
    EXPECT_EQ(measurementOf(state_).cells.size(), 1u);
    state_.b = state_.a;
    EXPECT_THAT(inputError([&] { (void)measurementOf(state_); }), HasSubstr("the same run"));
    state_.drive = keyboardDrive;
    EXPECT_THAT(inputError([&] { (void)measurementOf(state_); }), HasSubstr("save the recording"));
}

TEST_F(ShownMeasurement, EndsInAVerdictWithItsInterval) {
    const suite::Suite suite = measurementOf(state_);
    const auto sentences = measure(suite, out(), children(suite, half));
    EXPECT_THAT(sentences, Contains(AllOf(HasSubstr("frame_ms_median: B (octree_search) takes 0.5"), HasSubstr("["),
                                          HasSubstr("of the time of A (billboard): FASTER"))));
    // Without the null method's millisecond: (5 - 1) / (10 - 1).
    EXPECT_THAT(sentences,
                Contains(AllOf(HasSubstr("method_ms_median: B (octree_search) takes 0.44"), HasSubstr("FASTER"))));
    EXPECT_THAT(sentences, Contains(HasSubstr("A (billboard) takes 10.035 ms, 10.010 to 10.060 in 6 runs")));
    EXPECT_EQ(reported_.size(), 18u);
    EXPECT_THAT(reported_.back(), HasSubstr("run 18 of 18"));
    EXPECT_TRUE(fs::exists(out() / "summary.csv"));
    // Measured again, the old runs do not count.
    const auto again = measure(suite, out(), children(suite, [](const results::RunSpec& spec) {
                                   return spec.method == "octree_search" ? 2 * half(spec) : half(spec);
                               }));
    EXPECT_THAT(again, Contains(AllOf(HasSubstr("frame_ms_median: B"), HasSubstr("SAME"))));
}

TEST_F(ShownMeasurement, OfAAloneIsItsTime) {
    state_.b.reset();
    const suite::Suite suite = measurementOf(state_);
    const auto sentences = measure(suite, out(), children(suite, half));
    EXPECT_THAT(sentences.front(), HasSubstr("A (billboard) takes 10.035 ms"));
    EXPECT_EQ(sentences.size(), 2u);
}

TEST_F(ShownMeasurement, IsCancelledAtAnyMomentAndSaysSo) {
    const suite::Suite suite = measurementOf(state_);
    MeasurementHooks hooks = children(suite, half);
    hooks.execution.command = [](const fs::path&, const fs::path&) {
        return std::vector<std::string>{"/bin/sleep", "60"};
    };
    int asked = 0;
    hooks.cancelled = [&] { return ++asked == 3; };
    EXPECT_THAT(measure(suite, out(), hooks), ::testing::ElementsAre(HasSubstr("cancelled after 0 of 18 runs")));
}

TEST_F(ShownMeasurement, ARunThatFailsIsNamed) {
    const suite::Suite suite = measurementOf(state_);
    MeasurementHooks hooks = children(suite, half);
    hooks.execution.command = [](const fs::path&, const fs::path&) {
        return std::vector<std::string>{"/bin/sh", "-c", "echo no memory >&2; exit 1"};
    };
    EXPECT_THAT(measure(suite, out(), hooks), Contains(AllOf(HasSubstr("exit code 1"), HasSubstr("no memory"))));
}

TEST_F(ShownMeasurement, OfAViewerStartsWithTheNextFrame) {
    gpu::Device device;
    Viewer viewer(state_, device, folder_.path());
    viewer.paused = true;
    viewer.advance(1e9);
    viewer.press(Key::m, false);
    viewer.advance();
    EXPECT_THAT(viewer.message(), HasSubstr("cannot start runs"));
    MeasurementHooks hooks = children(measurementOf(viewer.state()), half);
    hooks.between = [&](const std::string& progress) {
        reported_.push_back(progress);
        EXPECT_EQ(viewer.message(), progress);
    };
    viewer.setMeasurement(hooks);
    viewer.press(Key::m, false);
    EXPECT_TRUE(viewer.measured().empty());
    viewer.advance();
    EXPECT_EQ(viewer.message(), "");
    EXPECT_EQ(reported_.size(), 18u);
    EXPECT_THAT(viewer.measured(), Contains(HasSubstr("FASTER")));
    ViewState alike = viewer.state();
    alike.b = alike.a;
    viewer.apply(alike);
    viewer.press(Key::m, false);
    viewer.advance();
    EXPECT_THAT(viewer.message(), HasSubstr("the same run"));
}

}  // namespace
}  // namespace dustbench::view
