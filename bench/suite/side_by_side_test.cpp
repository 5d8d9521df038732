#include "bench/suite/side_by_side.h"

#include <gmock/gmock.h>

#include "methods/contract/registry.h"
#include "methods/kit/testing/test_folder.h"

namespace dustbench::suite {
namespace {

using testing::AllOf;
using testing::HasSubstr;

class MethodComparison : public testing::Test {
 protected:
    void SetUp() override {
        if (std::ranges::none_of(methods(), [](const MethodInfo& info) { return info.id == "billboard"; }))
            GTEST_SKIP() << "no billboards here";
    }
    [[nodiscard]] static std::string refused(const std::vector<std::string>& variants,
                                             const results::ParameterTexts& given = {}) {
        return inputError([&] { (void)sideBySideSuite(variants, given, {}, 6); });
    }
};

TEST_F(MethodComparison, JudgesEveryVariantAndComparesEachWithTheFirst) {
    const Suite suite = sideBySideSuite({"billboard", "billboard:soft=true,sort=none", "billboard:sort=quicksort"},
                                        {{"particles", "70"}}, {}, 3);
    ASSERT_EQ(suite.cells.size(), 3u);
    EXPECT_EQ(suite.repetitions, 3);
    for (const PlannedRun& cell : suite.cells) {
        EXPECT_TRUE(cell.spec.metricPlan);
        EXPECT_EQ(cell.spec.parameters.at("particles"), "70");
    }
    EXPECT_EQ(suite.cells[1].label, "soft=on sort=none");
    ASSERT_EQ(suite.comparisons.size(), 2u);
    EXPECT_EQ(suite.comparisons[1].of.label, "billboard sort=quicksort");
    EXPECT_EQ(suite.comparisons[1].with.label, "billboard");
}

TEST_F(MethodComparison, JudgesOneRepetitionAlone) {
    const Suite suite = sideBySideSuite({"billboard", "billboard:soft=true"}, {}, {}, 4);
    int evaluated = 0;
    for (const PlannedRun& run : planRuns(suite)) evaluated += run.spec.metricPlan ? 1 : 0;
    EXPECT_EQ(evaluated, 2);
}

TEST_F(MethodComparison, GivesParametersToTheMethodsThatHaveThem) {
    const Suite suite = sideBySideSuite({"billboard", "billboard:soft=false"}, {{"soft", "true"}}, {}, 1);
    EXPECT_EQ(suite.cells[0].spec.parameters.at("soft"), "on");
    EXPECT_EQ(suite.cells[1].spec.parameters.at("soft"), "off");
}

TEST_F(MethodComparison, RefusesInOneLine) {
    EXPECT_THAT(refused({"billboard"}), HasSubstr("got 1 method"));
    EXPECT_THAT(refused({"billboard", "bilboard"}), HasSubstr("did you mean 'billboard'"));
    EXPECT_THAT(refused({"billboard", "billboard"}), HasSubstr("got 'billboard' twice"));
    EXPECT_THAT(refused({"billboard", "billboard:sort=radix"}), HasSubstr("twice"));  // the default
    EXPECT_THAT(refused({"billboard", "billboard:soft"}), HasSubstr("METHOD:name=value"));
    EXPECT_THAT(refused({"billboard", "billboard:"}), HasSubstr("METHOD:name=value"));
    EXPECT_THAT(refused({"billboard", "billboard:soft=true,soft=true"}), HasSubstr("sets soft twice"));
    EXPECT_THAT(refused({"billboard", "billboard:soft=2"}), AllOf(HasSubstr("soft"), HasSubstr("'2'")));
    EXPECT_THAT(refused({"billboard", "billboard:speed=5"}), HasSubstr("belongs to the world"));
    EXPECT_THAT(refused({"billboard", "billboard:soft=true"}, {{"sofd", "1"}}), HasSubstr("did you mean 'soft'"));
}

}  // namespace
}  // namespace dustbench::suite
