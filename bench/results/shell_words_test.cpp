#include "bench/results/shell_words.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <random>

#include "methods/kit/testing/test_input_error.h"

namespace dustbench::results {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

TEST(ShellWords, QuotedTextIsOneWordAgain) {
    std::mt19937 random(11);
    constexpr std::string_view letters = "ab 1;'\"\\$`\n\t-=,|*";
    for (int n = 0; n < 500; ++n) {
        std::vector<std::string> words;
        std::string line;
        for (std::size_t word = 0; word < 1 + random() % 4; ++word) {
            std::string text;
            for (std::size_t i = 0; i < random() % 8; ++i) text += letters[random() % letters.size()];
            line += (word > 0 ? " " : "") + shellQuoted(text);
            words.push_back(std::move(text));
        }
        EXPECT_EQ(shellWords(line), words) << line;
    }
}

TEST(ShellWords, AreReadAsAShellReadsThem) {
    EXPECT_THAT(shellWords(""), IsEmpty());
    EXPECT_THAT(shellWords("  a  b\tc\n"), ElementsAre("a", "b", "c"));
    EXPECT_THAT(shellWords("a'b c'd \"\" e\\ f"), ElementsAre("ab cd", "", "e f"));
    EXPECT_THAT(shellWords("run \\\n  --size 64x48"), ElementsAre("run", "--size", "64x48"));
    EXPECT_THAT(shellWords(R"("a\"b\\c\n" 'a\b')"), ElementsAre(R"(a"b\c\n)", R"(a\b)"));
    EXPECT_THAT(inputError([] { (void)shellWords("a 'b"); }), HasSubstr("a quote ' is not closed"));
}

}  // namespace
}  // namespace dustbench::results
