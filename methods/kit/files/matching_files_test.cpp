#include "methods/kit/files/matching_files.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "methods/kit/files/input_log.h"
#include "methods/kit/testing/test_folder.h"

namespace dustbench::files {
namespace {

using testing::ElementsAre;

std::vector<std::string> namesOf(const std::vector<std::filesystem::path>& found) {
    std::vector<std::string> names;
    names.reserve(found.size());
    for (const auto& file : found) names.push_back(file.filename().string());
    return names;
}

TEST(MatchingFiles, NumbersInNamesAreOrderedAsNumbers) {
    const TestFolder folder;
    const auto orderOf = [&](const std::string& pattern, const std::vector<const char*>& names) {
        for (const char* name : names) (void)folder.write(name, "");
        return namesOf(matchingFiles(folder.path() / pattern));
    };
    EXPECT_THAT(orderOf("smoke.*.vti", {"smoke.10.vti", "smoke.8.vti", "smoke.9.vti", "smoke.100.vti"}),
                ElementsAre("smoke.8.vti", "smoke.9.vti", "smoke.10.vti", "smoke.100.vti"));
    EXPECT_THAT(orderOf("*.vdb", {"a_2_10.vdb", "a_2_9.vdb", "a_10_1.vdb", "a.vdb", "b1.vdb", "B2.vdb"}),
                ElementsAre("B2.vdb", "a.vdb", "a_2_9.vdb", "a_2_10.vdb", "a_10_1.vdb", "b1.vdb"));
    EXPECT_THAT(orderOf("f*", {"f0010", "f9", "f09", "f18446744073709551616", "f18446744073709551617"}),
                ElementsAre("f09", "f9", "f0010", "f18446744073709551616", "f18446744073709551617"));
}

TEST(MatchingFiles, AStepThatIsNotEvenIsSaid) {
    EXPECT_EQ(unevenStep({"s.8.vti", "s.9.vti", "s.10.vti"}), "");
    EXPECT_EQ(unevenStep({"v2/s_000.vdb", "v2/s_010.vdb", "v2/s_020.vdb"}), "");
    EXPECT_EQ(unevenStep({"take2_008.vdb", "take2_009.vdb", "take2_011.vdb"}),
              "the numbers in the names step by 1, and by 2 from 'take2_009.vdb' to 'take2_011.vdb'");
    EXPECT_EQ(unevenStep({"s_1.vti", "s_01.vti", "s_2.vti"}),
              "the numbers in the names step by 0, and by 1 from 's_01.vti' to 's_2.vti'");
    // It is not clear which number counts.
    EXPECT_EQ(unevenStep({"a1_2.vti", "a2_3.vti", "a4_9.vti"}), "");
    EXPECT_EQ(unevenStep({"a.vti", "b.vti", "d.vti"}), "");
    EXPECT_EQ(unevenStep({}), "");
}

TEST(MatchingFiles, ThePatternIsNotedAndAPlainNameIsNot) {
    const TestFolder folder;
    (void)folder.write("a1.csv", "");
    const InputLog log;
    (void)matchingFiles(folder.path() / "a1.csv");
    EXPECT_TRUE(log.searches().empty());
    (void)matchingFiles(folder.path() / "a*.csv");
    EXPECT_THAT(log.searches(), ElementsAre(folder.path() / "a*.csv"));
    EXPECT_THAT(log.files(), ElementsAre(folder.path() / "a1.csv"));
}

}  // namespace
}  // namespace dustbench::files
