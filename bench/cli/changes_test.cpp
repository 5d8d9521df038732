// `--at`: changes during a run are part of its identity.
#include <gmock/gmock.h>

#include <algorithm>

#include "bench/cli/called_program.h"
#include "bench/results/stored_run.h"

namespace dustbench::cli {
namespace {

using testing::HasSubstr;

class Changes : public Dustbench {
 protected:
    void SetUp() override {
        Dustbench::SetUp();
        if (std::ranges::find(dustbench::methods(), "plugin_particles", &MethodInfo::id) == dustbench::methods().end())
            GTEST_SKIP() << "no method plugin_particles";
    }
    /// The run that these arguments make.
    bench::StoredRun run(const std::string& arguments) {
        const std::string out = (folder_ / std::to_string(++count_)).string();
        const Called called =
            call("run --method plugin_particles --frames 12 --warmup 2 --size 32x24 -P preroll=0.2 -P particles=300 " +
                 arguments + " --out " + out);
        EXPECT_EQ(called.code, 0) << called.err;
        kept_ = contentOf(runs(out).at(0) / "systems.toml");
        return bench::readRunFile(runs(out).at(0) / "run.json");
    }

    int count_ = 0;
    std::string kept_;
};

TEST_F(Changes, BelongToTheRunAndAreKept) {
    const auto plain = run(""), one = run("--at 0.1s:velocity.speed=8"), again = run("--at 0.10s:velocity.speed=8");
    EXPECT_EQ(one.runId, again.runId);
    EXPECT_EQ(one.methodHash, again.methodHash);
    EXPECT_EQ(one.parameters.at("at"), "0.1s:velocity.speed=8");
    EXPECT_NE(one.runId, plain.runId);
    EXPECT_EQ(plain.methodHash, plain.stateHash);
    EXPECT_NE(one.methodHash, plain.methodHash);
    EXPECT_EQ(one.stateHash, plain.stateHash) << "the shared dust is altered";
    const auto two = run("--at 0.1s:velocity.speed=8 --at 0.05s:size.part=constant");
    EXPECT_EQ(two.parameters.at("at"), "0.05s:size.part=constant;0.1s:velocity.speed=8");
    EXPECT_NE(two.methodHash, one.methodHash);
    EXPECT_THAT(kept_, testing::AllOf(HasSubstr("speed = 8\n"), HasSubstr("[size]\npart = \"constant\"")));
}

TEST_F(Changes, AreRefusedInOneLineWhereTheyCannotBe) {
    const std::vector<std::pair<std::string, std::string>> mistakes{
        {"plugin_particles --at -1s:velocity.speed=8", "at 0 s (the first recorded frame) or later"},
        {"plugin_particles --at 1:velocity.speed=8", "SECONDSs:NAME=VALUE"},
        {"plugin_particles --at 1s:velocty.speed=8", "'velocity'"},
        {"plugin_particles --at 1s:velocity.sped=8", "'speed'"},
        {"plugin_particles --at 1s:velocity.part=con", "'cone'"},
        {"plugin_particles --at 1s:velocity.speed=fast", "number 0..1000"},
        {"plugin_particles --frames 60 --at 1s:velocity.speed=8", "after the last frame"},
        {"plugin_particles -P system=wheel_dst", "'wheel_dust'"},
        {"null_method --at 1s:velocity.speed=8", "null_method"},
    };
    for (const auto& [arguments, expected] : mistakes) {
        const fs::path out = folder_ / "refused";
        const Called called = call("run -P preroll=0 --size 32x24 --method " + arguments + " --out " + out.string());
        EXPECT_EQ(called.code, 3) << arguments;
        // A progress line may precede it if only the run's process detects the mistake.
        const std::size_t at = called.err.find("dustbench: ");
        ASSERT_NE(at, std::string::npos) << called.err;
        EXPECT_EQ(std::ranges::count(called.err.substr(at), '\n'), 1) << called.err;
        EXPECT_THAT(called.err, HasSubstr(expected)) << arguments;
        EXPECT_TRUE(!fs::exists(out / "runs") || runs(out.string()).empty()) << arguments;
    }
}

}  // namespace
}  // namespace dustbench::cli
