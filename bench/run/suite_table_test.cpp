#include "bench/run/suite_table.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace dustbench::bench {

TEST(SuiteTable, ShowsWhatVariesAndTheMedianOverRepetitions) {
    Suite suite;
    suite.repetitions = 3;
    for (const char* count : {"100", "200"}) {
        PlannedRun cell;
        cell.spec.method = "haze";
        cell.spec.parameters = {{"particles", count}, {"speed", "20"}};
        suite.cells.push_back(cell);
    }
    std::map<std::string, StoredRun> runs;
    int fps = 10;
    for (const int repetition : {1, 2, 3}) {
        RunSpec spec = suite.cells[0].spec;
        spec.repetition = repetition;
        StoredRun run;
        run.cells = {{"fps_avg", std::to_string(fps)}, {"frame_ms_median", "5.5"}};
        fps += repetition * 10;  // 10, 20, 40
        runs[runId(spec)] = run;
    }
    const SuiteTable table = tabulate(suite, runs);
    EXPECT_THAT(std::vector<std::string>(table.header.begin(), table.header.begin() + 6),
                testing::ElementsAre("method", "particles", "runs", "fps", "min", "max"));
    ASSERT_EQ(table.rows.size(), 2u);
    EXPECT_THAT(std::vector<std::string>(table.rows[0].begin(), table.rows[0].begin() + 7),
                testing::ElementsAre("haze", "100", "3/3", "20.0", "10.0", "40.0", "5.50"));
    EXPECT_EQ(table.rows[1][2], "0/3");
    EXPECT_EQ(table.rows[1][3], "");
    EXPECT_EQ(table.rows[0].size(), table.header.size());
}

}  // namespace dustbench::bench
