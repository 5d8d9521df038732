#include "bench/results/merge.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <fstream>
#include <iterator>

#include "bench/results/stored_run.h"
#include "bench/results/summary.h"
#include "methods/contract/errors.h"

namespace dustbench::results {
namespace {
namespace fs = std::filesystem;

using testing::AllOf;
using testing::HasSubstr;

class Merge : public testing::Test {
 protected:
    void SetUp() override {
        folder_ = fs::path(testing::TempDir()) /
                  (std::string("merge-") + testing::UnitTest::GetInstance()->current_test_info()->name() + "-" +
                   std::to_string(getpid()));
        fs::remove_all(folder_);
    }
    void TearDown() override { fs::remove_all(folder_); }

    static RunSpec spec(int seed) {
        RunSpec spec;
        spec.method = "haze";
        spec.seed = static_cast<std::uint64_t>(seed);
        return spec;
    }
    static fs::path runFolder(const fs::path& folder, int seed) { return folder / "runs" / runId(spec(seed)); }
    static void write(const fs::path& file, const std::string& text) {
        fs::create_directories(file.parent_path());
        std::ofstream(file, std::ios::binary) << text;
    }
    static std::vector<MergeSource> read(const std::vector<fs::path>& folders) {
        std::vector<MergeSource> sources;
        sources.reserve(folders.size());
        for (const fs::path& folder : folders) sources.emplace_back(folder, readStoredRuns(folder));
        return sources;
    }
    static std::string content(const fs::path& file) {
        std::ifstream stream(file, std::ios::binary);
        return {std::istreambuf_iterator<char>(stream), {}};
    }
    /// A results folder with the runs of these seeds; `fps` distinguishes measurements.
    fs::path results(const std::string& name, const std::vector<int>& seeds, double fps = 30) const {
        for (const int seed : seeds) {
            RunRecord record;
            record.spec = spec(seed);
            record.summary = identityColumns(record, 2);
            record.summary.emplace_back("fps_avg", fps);
            write(runFolder(folder_ / name, seed) / "frames.csv", "frame\n0\n");
            write(runFolder(folder_ / name, seed) / "images" / "f000000.png", "picture");
            record.outputs = outputsIn(runFolder(folder_ / name, seed));
            write(runFolder(folder_ / name, seed) / "run.json", toJson(record));
        }
        fs::create_directories(folder_ / name / "runs");
        return folder_ / name;
    }
    [[nodiscard]] MergePlan mergeInto(const fs::path& out, const std::vector<fs::path>& sources) const {
        ResultsFolder folder(out);
        MergePlan plan = planMerge(read(sources), folder);
        EXPECT_TRUE(merge(plan, folder, [] { return false; }));
        return plan;
    }
    [[nodiscard]] std::string refusal(const std::vector<fs::path>& sources) const {
        try {
            ResultsFolder folder(folder_ / "out");
            (void)planMerge(read(sources), folder);
        } catch (const InputError& error) {
            return error.what();
        }
        return "nothing thrown";
    }

    fs::path folder_;
};

TEST_F(Merge, GivesTheRowsOfOneMachine) {
    const fs::path whole = results("whole", {1, 2, 3, 4, 5});
    ResultsFolder(whole).writeSummary();
    const std::vector<fs::path> shards{results("s1", {2, 5}), results("s2", {}), results("s3", {1, 3, 4})};
    write(shards[0] / "runs" / ".unfinished-x" / "run.json", "{");
    const MergePlan plan = mergeInto(folder_ / "out", shards);
    EXPECT_EQ(plan.copies.size(), 5u);
    EXPECT_EQ(content(folder_ / "out" / "summary.csv"), content(whole / "summary.csv"));
    for (int seed = 1; seed <= 5; ++seed)
        for (const char* file : {"run.json", "frames.csv", "images/f000000.png"})
            EXPECT_EQ(content(runFolder(folder_ / "out", seed) / file), content(runFolder(whole, seed) / file));
    EXPECT_TRUE(fs::exists(shards[0] / "runs" / ".unfinished-x"));
    EXPECT_FALSE(fs::exists(folder_ / "out" / "runs" / ".unfinished-x"));
}

TEST_F(Merge, TakesEqualResultsOnceAndGoesOnWhereItWas) {
    const fs::path a = results("a", {1, 2}), b = results("b", {2, 3});
    MergePlan plan = mergeInto(folder_ / "out", {a, b});
    EXPECT_EQ(plan.copies.size(), 3u);
    EXPECT_EQ(plan.there, 1u);
    // State after an interruption: one run missing, one half copied, no summary.
    fs::remove_all(runFolder(folder_ / "out", 3));
    write(folder_ / "out" / "runs" / (".unfinished-" + runId(spec(3))) / "run.json", "{");
    const std::string summary = content(folder_ / "out" / "summary.csv");
    fs::remove(folder_ / "out" / "summary.csv");
    plan = mergeInto(folder_ / "out", {a, b});
    EXPECT_EQ(plan.copies.size(), 1u);
    EXPECT_EQ(plan.there, 3u);
    EXPECT_EQ(content(folder_ / "out" / "summary.csv"), summary);
    EXPECT_TRUE(mergeInto(folder_ / "out", {folder_ / "out"}).copies.empty());
}

TEST_F(Merge, AnInterruptionLosesNothing) {
    const fs::path a = results("a", {1, 2, 3});
    {
        ResultsFolder out(folder_ / "out");
        int asked = 0;
        EXPECT_FALSE(merge(planMerge(read({a}), out), out, [&asked] { return ++asked > 2; }));
        EXPECT_EQ(out.runs().size(), 2u);
    }
    EXPECT_EQ(mergeInto(folder_ / "out", {a}).copies.size(), 1u);
}

TEST_F(Merge, RefusesTwoResultsOfOneRun) {
    const fs::path a = results("a", {1}), b = results("b", {1}, 31);
    EXPECT_THAT(refusal({a, b}), AllOf(HasSubstr(runId(spec(1))), HasSubstr("two different results"),
                                       HasSubstr("a/runs"), HasSubstr("b/runs")));
    (void)mergeInto(folder_ / "out", {a});
    EXPECT_THAT(refusal({b}), HasSubstr("two different results"));
    // An additional file.
    const fs::path c = results("c", {1});
    write(runFolder(c, 1) / "notes.txt", "slow");
    EXPECT_THAT(refusal({c}), HasSubstr("two different results"));
}

TEST_F(Merge, RefusesResultsThatWereAltered) {
    const fs::path a = results("a", {1, 2});
    write(runFolder(a, 2) / "frames.csv", "fra");  // truncated during copying
    EXPECT_THAT(refusal({a}), AllOf(HasSubstr(runFolder(a, 2).string()), HasSubstr("frames.csv has 3 bytes")));
    write(runFolder(a, 2) / "frames.csv", "frame\n1\n");
    EXPECT_THAT(refusal({a}), HasSubstr("its SHA-256 differs"));
    fs::remove(runFolder(a, 2) / "images" / "f000000.png");
    EXPECT_THAT(refusal({a}), HasSubstr("images/f000000.png is missing"));
    EXPECT_FALSE(fs::exists(runFolder(folder_ / "out", 1)));
}

TEST_F(Merge, NamesWhatIsMissingOrBroken) {
    const fs::path a = results("a", {1});
    EXPECT_THAT(refusal({a, folder_ / "b"}), AllOf(HasSubstr("/b'"), HasSubstr("not a results folder")));
    write(runFolder(a, 1) / "run.json", "{\"run_id\":");
    EXPECT_THAT(refusal({a}), HasSubstr((runFolder(a, 1) / "run.json").string()));
    const fs::path moved = results("moved", {1});
    fs::rename(runFolder(moved, 1), moved / "runs" / "haze-mine");
    EXPECT_THAT(refusal({moved}), AllOf(HasSubstr("haze-mine"), HasSubstr("named after")));
    const fs::path empty = results("empty", {});
    fs::create_directories(empty / "runs" / "haze-plain-r1-000000000000");
    EXPECT_THAT(refusal({empty}), HasSubstr("haze-plain-r1-000000000000/run.json"));
}

TEST_F(Merge, PassesOverStrayFiles) {
    const fs::path a = results("a", {1, 2});
    write(a / "runs" / "notes.txt", "measured on a Monday");
    EXPECT_EQ(mergeInto(folder_ / "out", {a}).copies.size(), 2u);
    EXPECT_FALSE(fs::exists(folder_ / "out" / "runs" / "notes.txt"));
}

TEST_F(Merge, TakesNothingFromOutsideItsFolders) {
    write(folder_ / "secret", "not a result");
    const auto withLink = [&](const char* name, const fs::path& link, const fs::path& target) {
        const fs::path source = results(name, {1, 2});
        fs::remove_all(source / "runs" / link);
        fs::create_symlink(target, source / "runs" / link);
        return refusal({source});
    };
    const fs::path run = runId(spec(1));
    EXPECT_THAT(withLink("file", run / "frames.csv", folder_ / "secret"), HasSubstr("frames.csv is a symbolic link"));
    EXPECT_THAT(withLink("more", run / "more.txt", "../../../../secret"), HasSubstr("more.txt': is a symbolic link"));
    const fs::path images = runFolder(results("same", {1}), 1) / "images";
    EXPECT_THAT(withLink("folders", run / "images", images), HasSubstr("images': is a symbolic link"));
    EXPECT_THAT(withLink("round", run / "round", "round"), HasSubstr("round': is a symbolic link"));
    const fs::path honest = results("honest", {1});
    EXPECT_THAT(withLink("whole", run, runFolder(honest, 1)), HasSubstr(run.string() + "': is a symbolic link"));
    const fs::path piped = results("piped", {1});
    ASSERT_EQ(mkfifo((runFolder(piped, 1) / "pipe").c_str(), 0600), 0);
    EXPECT_THAT(refusal({piped}), HasSubstr("pipe': is not a regular file"));
    const fs::path linked = folder_ / "linked";
    fs::create_directories(linked);
    fs::create_symlink(honest / "runs", linked / "runs");
    EXPECT_THAT(refusal({linked}), HasSubstr("runs': is a symbolic link"));
    EXPECT_FALSE(fs::exists(folder_ / "out"));
    // The folder itself may be named by a link.
    fs::create_symlink(honest, folder_ / "by-name");
    EXPECT_EQ(mergeInto(folder_ / "out", {folder_ / "by-name"}).copies.size(), 1u);
}

TEST_F(Merge, SaysWhereItDoesNotFit) {
    const fs::path a = results("a", {1, 2});
    ResultsFolder out(folder_ / "out");
    const MergePlan plan = planMerge(read({a}), out);
    std::uintmax_t bytes = 0;
    for (const auto& entry : fs::recursive_directory_iterator(a))
        if (entry.is_regular_file()) bytes += entry.file_size();
    EXPECT_EQ(plan.bytes, bytes);
    EXPECT_NO_THROW(requireSpace(plan, out.path(), bytes));
    EXPECT_THROW(requireSpace(plan, out.path(), bytes - 1), InputError);
}

}  // namespace
}  // namespace dustbench::results
