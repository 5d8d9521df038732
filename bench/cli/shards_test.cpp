// End-to-end tests of a suite in parts: `suite --shard`, `merge`, and the script of `suite --slurm` without Slurm.
#include <gmock/gmock.h>

#include "bench/cli/called_program.h"
#include "bench/results/compared_runs.h"
#include "methods/kit/files/csv.h"

namespace dustbench::cli {
namespace {

using testing::AllOf;
using testing::HasSubstr;

class Shards : public Dustbench {
 protected:
    void SetUp() override {
        Dustbench::SetUp();
        std::ofstream(folder_ / "its own.toml") << fmt::format(
            "title = \"Two clouds\"\nmethods = [\"{}\"]\nsizes = [\"64x48\"]\nframes = 2\nwarmup = 0\nrepetitions = 2\n"
            "baseline = false\n[parameters]\npreroll = 0.1\nparticles = [50, 100]\n",
            methods().front().id);
        suite_ = fmt::format("suite '{}/its own.toml'", folder_.string());
    }
    [[nodiscard]] std::string shardFolder(int index) const { return fmt::format("{}/shards/{}-of-3", out(), index); }
    [[nodiscard]] Called bash(const std::string& command) const {
        const std::string line = fmt::format("cd '{0}' && {1} >'{0}/stdout' 2>'{0}/stderr'", folder_.string(), command);
        const int status = std::system(line.c_str());
        return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, contentOf(folder_ / "stdout"),
                contentOf(folder_ / "stderr")};
    }

    std::string suite_;
};

TEST_F(Shards, MergedAreTheSuite) {
    std::string sources;
    for (int index = 1; index <= 3; ++index) {
        const Called called = call(fmt::format("{} --shard {}/3 --out '{}'", suite_, index, shardFolder(index)));
        ASSERT_EQ(called.code, 0) << called.err;
        EXPECT_EQ(runs(shardFolder(index)).size(), index == 3 ? 0u : 2u);
        EXPECT_EQ(called.err.find("shard 3/3 of its own has no runs") != std::string::npos, index == 3) << called.err;
        sources += fmt::format(" '{}'", shardFolder(index));
    }
    const Called merged = call(fmt::format("merge --out '{}' {}", out(), sources));
    ASSERT_EQ(merged.code, 0) << merged.err;
    EXPECT_THAT(merged.err, HasSubstr("4 copied, 0 existing"));
    EXPECT_EQ(files::CsvTable::parseFile(merged.out.substr(0, merged.out.size() - 1)).rows(), 4u);
    EXPECT_THAT(call(fmt::format("merge --out '{}' {}", out(), sources)).err, HasSubstr("0 copied, 4 existing"));
    EXPECT_THAT(call(fmt::format("{} --out '{}'", suite_, out())).err, HasSubstr("4 existing"));
}

TEST_F(Shards, BadInputIsOneLineAndExitCodeThree) {
    const std::string there = shardFolder(1);
    fs::create_directories(there + "/runs/cut");
    std::ofstream(there + "/runs/cut/run.json") << "{\"run_id\": ";
    for (const auto& [arguments, word] : std::vector<std::pair<std::string, std::string>>{
             {suite_ + " --out o --shard 0/3", "'0/3'"},
             {suite_ + " --out o --shard 4/3", "'4/3'"},
             {suite_ + " --out o --shard x", "I/N"},
             {suite_ + " --out o --slurm 2 --shard 1/2", "--slurm"},
             {suite_ + " --out o --slurm 2 --dry-run", "--dry-run"},
             {suite_ + " --out o --slurm many", "'many'"},
             {fmt::format("merge --out '{}/m' '{}'", folder_.string(), there), "cut/run.json"},
             {fmt::format("merge --out '{0}/m' '{0}/nowhere'", folder_.string()), "nowhere"},
             {fmt::format("merge --out '{}/m'", folder_.string()), "folders"}}) {
        const Called called = call(arguments);
        EXPECT_EQ(called.code, 3) << arguments;
        EXPECT_THAT(called.err, HasSubstr(word));
        EXPECT_EQ(std::ranges::count(called.err, '\n'), 1) << called.err;
    }
    EXPECT_FALSE(fs::exists(folder_ / "m"));
}

TEST_F(Shards, AMergeThatIsRefusedLeavesNoFolder) {
    const fs::path own = folder_ / "own", linked = folder_ / "linked";
    fs::create_directories(own / "runs");
    fs::create_directories(linked);
    fs::create_symlink(own / "runs", linked / "runs");
    const std::string merge = fmt::format("merge --out '{}' '{}'", (folder_ / "m").string(), linked.string());
    EXPECT_EQ(call(merge).code, 3);
    EXPECT_FALSE(fs::exists(folder_ / "m"));
    // Existing results stay.
    fs::create_directories(folder_ / "m");
    EXPECT_EQ(call(merge).code, 3);
    EXPECT_TRUE(fs::is_empty(folder_ / "m"));
}

TEST_F(Shards, TheScriptForSlurmCountsTheRunsOfTheNullMethod) {
    if (!results::findBaseline() || methods().front().id == results::baselineMethod)
        GTEST_SKIP() << "no null method here, or no other";
    std::ofstream(folder_ / "timed.toml") << fmt::format(
        "methods = [\"{}\"]\nrepetitions = 2\n[parameters]\nparticles = [50, 100, 150]\n", methods().front().id);
    const Called called = call(fmt::format("suite '{}/timed.toml' --slurm 2 --out o", folder_.string()));
    ASSERT_EQ(called.code, 0) << called.err;
    EXPECT_THAT(called.out, HasSubstr("12 runs in 2 shards, 8 in the"));
}

TEST_F(Shards, TheScriptForSlurmRunsAShardAndSubmitsItselfAndTheMerge) {
    ASSERT_EQ(bash(fmt::format("'{}' suite 'its own.toml' --repetitions=1 --timeout 100 --slurm 2 --out \"it's\"",
                               DUSTBENCH_PROGRAM))
                  .code,
              0);
    const std::string script = contentOf(folder_ / "stdout");
    EXPECT_THAT(script, AllOf(HasSubstr("#SBATCH --array=1-2\n"), HasSubstr("#SBATCH --exclusive\n"),
                              HasSubstr("#SBATCH --time=0-00:04:00\n"), HasSubstr("2 runs in 2 shards, 1 in the"),
                              HasSubstr("suite 'its own.toml' --repetitions=1 --timeout 100 \\\n")));
    EXPECT_FALSE(fs::exists(folder_ / "it's"));
    std::ofstream(folder_ / "job.sh") << script;
    // Runs a task as Slurm does.
    for (int task = 1; task <= 2; ++task)
        EXPECT_EQ(bash(fmt::format("SLURM_ARRAY_TASK_ID={} bash job.sh", task)).code, 0);
    // A stand-in for sbatch: records its arguments, and runs the script it reads.
    fs::create_directories(folder_ / "bin");
    std::ofstream(folder_ / "bin/sbatch") << "#!/bin/bash\necho \"$*\" >> given\n"
                                             "[[ $* == *job.sh ]] && echo '7;cluster' && exit\n"
                                             "bash > merged 2>&1 && echo 8\n";
    fs::permissions(folder_ / "bin/sbatch", fs::perms::owner_all);
    const Called submitted = bash("PATH=\"$PWD/bin:$PATH\" bash job.sh");
    EXPECT_EQ(submitted.code, 0) << submitted.err;
    EXPECT_EQ(submitted.out, "7 8\n");
    EXPECT_THAT(contentOf(folder_ / "given"), HasSubstr("--dependency=afterany:7 "));
    EXPECT_THAT(contentOf(folder_ / "merged"), HasSubstr("2 copied"));
    EXPECT_EQ(files::CsvTable::parseFile(folder_ / "it's" / "summary.csv").rows(), 2u);
}

}  // namespace
}  // namespace dustbench::cli
