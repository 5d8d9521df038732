#include "methods/kit/files/toml_nesting.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "methods/kit/files/toml_reader.h"
#include "methods/kit/testing/test_input_error.h"

namespace dustbench::files {
namespace {

std::string times(std::size_t count, const std::string& text) {
    std::string all;
    for (std::size_t i = 0; i < count; ++i) all += text;
    return all;
}

TEST(TomlNesting, FindsTheLineThatIsTooDeep) {
    EXPECT_EQ(tooDeepLine("a = 1\n[b.c]\nd = [[1.5, 2.5], {e = 1}]\n", 8), 0u);
    EXPECT_EQ(tooDeepLine("a = 1\nb = " + times(9, "[") + times(9, "]"), 8), 2u);
    EXPECT_EQ(tooDeepLine("\n\n" + times(9, "a.") + "a = 1\n", 8), 3u);
    EXPECT_EQ(tooDeepLine("[" + times(9, "a.") + "a]\n", 8), 1u);
    EXPECT_EQ(tooDeepLine("[[" + times(9, "'a' . ") + "a]]\n", 8), 1u);
    EXPECT_EQ(tooDeepLine("a = " + times(9, "{a = ") + "1" + times(9, "}"), 8), 1u);
    // Levels of header, key and brackets add up.
    EXPECT_EQ(tooDeepLine("[a.a.a.a]\nb.b.b = {c.c.c = 1}\n", 8), 2u);
    EXPECT_EQ(tooDeepLine("[a.a.a.a]\n[b]\nb.b.b = {c.c = 1}\n", 9), 0u);
}

TEST(TomlNesting, PassesOverTextCommentsAndSiblings) {
    const std::string deep = times(50, "[{a.");
    for (const std::string& text :
         {"a = \"" + deep + "\\\" " + deep + "\"\n", "a = '" + deep + "'\n", "a = 1 # " + deep + "\n",
          "a = \"\"\"\n" + deep + "\n\" \"\"\"\n", "a = '''\n" + deep + "'''\n", "\"" + deep + "\" = 1\n",
          "a = [" + times(1000, "[1.5], {b.c = 2}, 3.5,\n") + "]\n", times(1000, "[a.b]\nc.d = 1.5\n"),
          "a = [" + times(1000, "1.5, ") + "]\n"})
        EXPECT_EQ(tooDeepLine(text, 8), 0u) << text.substr(0, 60);
}

TEST(TomlNesting, KeepsTheReaderFromOverflowing) {
    for (const std::string& text :
         {"a = " + times(31'000, "[") + times(31'000, "]"), "a = " + times(31'000, "{a = ") + "1" + times(31'000, "}"),
          times(31'000, "a.") + "a = 1\n", "[" + times(31'000, "a.") + "a]\n", "[[" + times(31'000, "a.") + "a]]\n",
          "[" + times(200, "a.") + "a]\n" + times(200, "b.") + "b = {" + times(200, "c.") + "c = 1}\n"})
        EXPECT_THAT(inputError([&] { (void)TomlReader::parseText(text, "t.toml"); }),
                    ::testing::HasSubstr("nest too deeply, allowed: 256 levels"));
    EXPECT_NO_THROW((void)TomlReader::parseText("a = " + times(200, "[") + times(200, "]") + "\n", "t.toml"));
}

}  // namespace
}  // namespace dustbench::files
