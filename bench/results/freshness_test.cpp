#include "bench/results/freshness.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "methods/kit/files/data_folder.h"
#include "methods/kit/files/input_log.h"
#include "methods/kit/files/matching_files.h"
#include "methods/kit/testing/test_folder.h"

namespace dustbench::results {
namespace {

using testing::HasSubstr;

StoredRun runAfter(const files::InputLog& log) {
    StoredRun run;
    run.provenance = {{"build_id", "0123"}};
    run.inputs = measure::hashInputs(log.files());
    run.searches = measure::hashSearches(log.searches());
    return run;
}

TEST(Freshness, NoticesThatOtherFilesMatchAPattern) {
    const TestFolder folder;
    (void)folder.write("s_08.vti", "8");
    (void)folder.write("s_09.vti", "9");
    const files::InputLog log;
    (void)files::matchingFiles(folder.path() / "s_*.vti");
    const StoredRun run = runAfter(log);
    EXPECT_EQ(Freshness("0123").whyOutdated(run), "");
    (void)folder.write("other_05.vti", "5");
    EXPECT_EQ(Freshness("0123").whyOutdated(run), "");
    (void)folder.write("s_05.vti", "5");
    EXPECT_THAT(Freshness("0123").whyOutdated(run), HasSubstr("now match"));
    std::filesystem::remove(folder.path() / "s_05.vti");
    EXPECT_EQ(Freshness("0123").whyOutdated(run), "");
    std::filesystem::remove(folder.path() / "s_08.vti");
    EXPECT_THAT(Freshness("0123").whyOutdated(run), HasSubstr("s_08.vti can no longer be read"));
}

TEST(Freshness, NoticesAFileThatStandsBeforeTheDeliveredOne) {
    const TestFolder folder;
    const files::InputLog log;
    (void)files::fileNamedBy(folder.path() / "own.toml", "scenes", "heights/dunes.png");
    const StoredRun run = runAfter(log);
    EXPECT_EQ(Freshness("0123").whyOutdated(run), "");
    std::filesystem::create_directories(folder.path() / "heights");
    (void)folder.write("heights/dunes.png", "");
    EXPECT_THAT(Freshness("0123").whyOutdated(run), HasSubstr("heights/dunes.png did not exist and now does"));
}

}  // namespace
}  // namespace dustbench::results
