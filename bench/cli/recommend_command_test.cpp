#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "bench/cli/called_program.h"
#include "source_folder.h"

namespace dustbench::cli {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

class Recommend : public Dustbench {
 protected:
    [[nodiscard]] Called ask(const std::string& more) const {
        return call("recommend --from '" DUSTBENCH_SOURCE_DIR "/reports/sample/carr2006' " + more);
    }
};

TEST_F(Recommend, AnswersThreeBudgetsFromTheSample) {
    const Called none = ask("--budget 0.1ms"), some = ask("--budget 3ms --where particles=2000"),
                 all = ask("--budget '100 ms' --where particles=2000");
    EXPECT_EQ(none.code, 5);
    EXPECT_THAT(none.out, AllOf(HasSubstr("nothing fits 0.1 ms; the cheapest is"), Not(HasSubstr("recommended"))));
    EXPECT_EQ(some.code, 0);
    EXPECT_THAT(some.out, AllOf(HasSubstr("recommended     octree"), HasSubstr("over budget     billboard")));
    EXPECT_EQ(all.code, 0);
    EXPECT_THAT(all.out, HasSubstr("recommended     billboard"));
    for (const std::string& said : {none.out, some.out, all.out})
        EXPECT_THAT(said, AllOf(HasSubstr("popping"), HasSubstr("gaps"), HasSubstr("measured on: AMD EPYC"),
                                HasSubstr("warning: software renderer"), HasSubstr("one seed")));
}

TEST_F(Recommend, RefusesWhatItDoesNotKnowInOneLine) {
    for (const char* bad : {"--budget 4", "--budget 4ms --light sun", "--budget 4ms --where particles=7",
                            "--budget 4ms --where =7", "--budget 4ms --quality psnr", "--budget 4ms --chart a.gif"}) {
        const Called called = ask(bad);
        EXPECT_EQ(called.code, 3) << bad;
        EXPECT_THAT(called.err, StartsWith("dustbench: --")) << bad;
        EXPECT_EQ(std::ranges::count(called.err, '\n'), 1) << called.err;
    }
}

TEST_F(Recommend, SaysThatNothingCanBeRanked) {
    std::ofstream(folder_ / "summary.csv") << "run_id,status,method,scene,seed,method_ms_median\na,done,b,plain,1,2\n";
    const Called called = call("recommend --from " + (folder_ / "summary.csv").string() + " --budget 4ms");
    EXPECT_EQ(called.code, 6);
    EXPECT_THAT(called.err, AllOf(HasSubstr("no setting has both"), HasSubstr("a time but no psnr_mask_db (1)")));
}

}  // namespace
}  // namespace dustbench::cli
