#include "bench/results/compared_runs.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <functional>

#include "methods/contract/registry.h"

namespace dustbench::results {
namespace {

class MethodTime : public testing::Test {
 protected:
    void SetUp() override {
        if (!findBaseline() || methods().size() < 2) GTEST_SKIP() << "no null method here, or no other";
        for (const MethodInfo& info : methods())
            if (info.id != baselineMethod) other_ = info.id;
    }
    [[nodiscard]] RunSpec specOf(std::string method, const ParameterTexts& given = {}) const {
        RunSpec spec;
        spec.parameters = canonicalParameters(findMethod(method), given);
        spec.method = std::move(method);
        return spec;
    }
    StoredRun& store(const RunSpec& spec, const std::string& ms, const std::string& cpu = "A") {
        StoredRun& run = runs_[runId(spec)] = {};
        run.runId = runId(spec);
        run.parameters = spec.parameters;
        run.cells = {{"method", spec.method}, {"frame_ms_median", ms}};
        run.provenance = {{"key", canonicalKey(spec)}, {"cpu", cpu}};
        return run;
    }
    /// Empty if the column is empty.
    [[nodiscard]] std::string timeOf(const RunSpec& spec) {
        addMethodTimes(runs_);
        const auto& cells = runs_.at(runId(spec)).cells;
        const auto found = cells.find("method_ms_median");
        return found == cells.end() ? "" : found->second;
    }

    std::string other_;
    StoredRuns runs_;
};

TEST_F(MethodTime, IsTheFrameLessTheNullMethodsOfTheSameSeedAndRepetition) {
    for (const std::uint64_t seed : {1u, 2u, 3u})
        for (const int repetition : {1, 2}) {
            RunSpec method = specOf(other_), null = specOf(std::string(baselineMethod));
            method.seed = null.seed = seed;
            method.repetition = null.repetition = repetition;
            const int nullMs = 4 * static_cast<int>(seed) + repetition;
            store(null, std::to_string(nullMs));
            store(method, std::to_string(nullMs + 10 * repetition) + ".5");
        }
    for (const std::uint64_t seed : {1u, 2u, 3u})
        for (const int repetition : {1, 2}) {
            RunSpec method = specOf(other_), null = specOf(std::string(baselineMethod));
            method.seed = null.seed = seed;
            method.repetition = null.repetition = repetition;
            EXPECT_EQ(timeOf(method), repetition == 1 ? "10.5" : "20.5");
            EXPECT_EQ(timeOf(null), "");
        }
}

TEST_F(MethodTime, IsEmptyWithoutANullRunInTheSameWorld) {
    const RunSpec method = specOf(other_);
    const RunSpec null = specOf(std::string(baselineMethod));
    const std::vector<std::pair<const char*, std::function<void(RunSpec&)>>> others{
        {"seed", [](RunSpec& spec) { spec.seed = 2; }},
        {"repetition", [](RunSpec& spec) { spec.repetition = 2; }},
        {"size",
         [](RunSpec& spec) {
             spec.size = {320, 240};
         }},
        {"scene", [](RunSpec& spec) { spec.scene = "sphere"; }},
        {"drive", [](RunSpec& spec) { spec.drive = "slalom"; }},
        {"frames", [](RunSpec& spec) { spec.frames = 7; }},
        {"warmup", [](RunSpec& spec) { spec.warmup = 7; }},
        {"threads", [](RunSpec& spec) { spec.threads = 1; }},
        {"sync", [](RunSpec& spec) { spec.sync = Sync::stage; }},
        {"world's parameter", [](RunSpec& spec) { spec.parameters["speed"] = "33"; }},
        {"null method's work", [](RunSpec& spec) { spec.parameters["work"] = "5"; }}};
    for (const auto& [what, change] : others) {
        runs_.clear();
        RunSpec changed = null;
        change(changed);
        store(method, "9");
        store(changed, "5");
        EXPECT_EQ(timeOf(method), "") << what;
    }
    runs_.clear();
    store(method, "9");
    store(null, "5", "B");
    EXPECT_EQ(timeOf(method), "") << "another machine";
    store(null, "5").status = RunStatus::failed;
    EXPECT_EQ(timeOf(method), "") << "failed";
    store(null, "");
    EXPECT_EQ(timeOf(method), "") << "no time";
    store(null, "5").provenance.erase("key");
    EXPECT_EQ(timeOf(method), "") << "no key";
    store(null, "5");
    EXPECT_EQ(timeOf(method), "4");
}

TEST_F(MethodTime, DoesNotDependOnWhatIsDoneBetweenFrames) {
    RunSpec method = specOf(other_);
    method.imagesEvery = 5;
    method.metricPlan.emplace();
    method.volumes.emplace();
    store(method, "9");
    store(specOf(std::string(baselineMethod)), "5");
    EXPECT_EQ(timeOf(method), "4");
}

TEST_F(MethodTime, OfTheNullMethodWithWorkIsThatWork) {
    const RunSpec working = specOf(std::string(baselineMethod), {{"work", "50"}});
    store(working, "7");
    store(specOf(std::string(baselineMethod)), "5");
    EXPECT_EQ(timeOf(working), "2");
}

TEST_F(MethodTime, GoesWhenItsNullRunGoes) {
    const RunSpec method = specOf(other_), null = specOf(std::string(baselineMethod));
    store(method, "9");
    store(null, "5");
    EXPECT_EQ(timeOf(method), "4");
    runs_.erase(runId(null));
    EXPECT_EQ(timeOf(method), "");
}

}  // namespace
}  // namespace dustbench::results
