#include "bench/results/results_folder.h"

#include <gtest/gtest.h>

#include "methods/kit/testing/test_folder.h"

namespace dustbench::results {
namespace {
namespace fs = std::filesystem;

TEST(ResultsFolder, GoesAgainIfNothingWasWritten) {
    const TestFolder folder;
    const fs::path out = folder.path() / "results" / "out";
    {
        ResultsFolder results(out);
        const fs::path run = results.beginRun("haze-plain-r1-000000000000");
        EXPECT_TRUE(fs::exists(run));
        EXPECT_TRUE(fs::create_directory(referencesBeside(run)));
        results.discard("haze-plain-r1-000000000000");
        EXPECT_TRUE(fs::exists(out / "runs"));
    }
    EXPECT_FALSE(fs::exists(out));
    EXPECT_TRUE(fs::exists(folder.path()));
}

TEST(ResultsFolder, HasNoReferencesOfAnInterruptedProgram) {
    const TestFolder folder;
    folder.write("runs/.references/image", "of another build");
    const ResultsFolder results(folder.path());
    EXPECT_FALSE(fs::exists(folder.path() / "runs" / ".references"));
}

TEST(ResultsFolder, StaysIfItWasThereOrHoldsAnything) {
    const TestFolder folder;
    fs::create_directory(folder.path() / "mine");
    { const ResultsFolder results(folder.path() / "mine"); }
    EXPECT_TRUE(fs::exists(folder.path() / "mine" / "runs"));
    {
        const ResultsFolder results(folder.path() / "noted");
        folder.write("noted/notes.txt", "of somebody");
    }
    EXPECT_TRUE(fs::exists(folder.path() / "noted" / "runs"));
    EXPECT_TRUE(fs::exists(folder.path() / "noted" / "notes.txt"));
    {
        ResultsFolder results(folder.path() / "summed");
        results.writeSummary();
    }
    EXPECT_TRUE(fs::exists(folder.path() / "summed" / "summary.csv"));
}

}  // namespace
}  // namespace dustbench::results
