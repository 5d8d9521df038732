#include "bench/selfcheck/selfcheck_report.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

#include "bench/results/temporary_folder.h"

namespace dustbench::selfcheck {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

TEST(SelfcheckProblems, NameEachFailedCheckAndNothingElse) {
    const results::TemporaryFolder folder;
    EXPECT_THAT(selfcheckProblems(folder.path()), IsEmpty());
    const auto check = [](const std::string& name, const std::string& outcome) {
        return R"({"name": ")" + name + R"(", "outcome": ")" + outcome +
               R"(", "measured": "7", "expected": "8", "note": ""})";
    };
    std::ofstream(folder.path() / "selfcheck.json")
        << R"({"passed": false, "checks": [)" << check("clock", "ok") << "," << check("atomics", "failed") << ","
        << check("timer queries", "attention") << "]}";
    EXPECT_THAT(selfcheckProblems(folder.path()),
                ElementsAre("the self-check failed, the results may be wrong: atomics: got 7, expected 8"));
}

TEST(SelfcheckProblems, SayThatAFileCannotBeRead) {
    for (const char* text : {"", "{", "[]", R"({"checks": [{"name": 1}]})"}) {
        const results::TemporaryFolder folder;
        std::ofstream(folder.path() / "selfcheck.json") << text;
        EXPECT_THAT(selfcheckProblems(folder.path()), ElementsAre(HasSubstr("cannot be read"))) << text;
    }
}

}  // namespace
}  // namespace dustbench::selfcheck
