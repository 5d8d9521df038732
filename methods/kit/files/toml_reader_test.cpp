#include "methods/kit/files/toml_reader.h"

#include "methods/kit/files/toml_text.h"
#include "methods/kit/testing/test_input_error.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace dustbench::files {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

TEST(TomlReader, GivesTypedValuesAndDefaults) {
    auto reader = TomlReader::parseText("a = 1.5\nb = 3\nc = 'x'\nd = true\ne = [1, 2.5, 3]\n", "t.toml");
    EXPECT_EQ(reader.number("a", 0, 2), 1.5);
    EXPECT_EQ(reader.number("b", 0, 5), 3);
    EXPECT_EQ(reader.integer("b", 0, 5), 3);
    EXPECT_EQ(reader.text("c"), "x");
    EXPECT_TRUE(reader.boolean("d", false));
    EXPECT_EQ(reader.vector3("e"), glm::dvec3(1, 2.5, 3));
    EXPECT_EQ(reader.number("missing", 0, 1, 0.25), 0.25);
    EXPECT_NO_THROW(reader.finish());
}

TEST(TomlReader, NamesFileLineKeyGotAndExpected) {
    auto reader = TomlReader::parseText("\nwind = 'strong'\n", "s.toml");
    EXPECT_EQ(inputError([&] { (void)reader.number("wind", 0, 9); }),
              "s.toml:2: key 'wind': got 'strong', expected a number 0..9");
    EXPECT_THAT(inputError([&] { (void)reader.number("rain", 0, 9); }), HasSubstr("'rain' is missing"));
}

TEST(TomlReader, RefusesValuesOutOfRangeAndNotFinite) {
    auto reader = TomlReader::parseText("a = 7\nb = nan\nc = inf\n", "t");
    for (const char* key : {"a", "b", "c"}) EXPECT_THROW((void)reader.number(key, 0, 5), InputError) << key;
}

TEST(TomlReader, RefusesKeysThatNobodyAskedForWithTheNearest) {
    auto reader = TomlReader::parseText("[sun]\nelevatoin = 3\n", "t.toml");
    auto sun = reader.table("sun");
    (void)sun.number("elevation", 0, 90, 45);
    EXPECT_EQ(inputError([&] { sun.finish(); }),
              "t.toml:2: unknown key in [sun] 'elevatoin' (did you mean 'elevation'?); known: elevation");
}

TEST(TomlReader, SuggestsKeysThatWereLookedFor) {
    auto reader = TomlReader::parseText("methdos = ['a']\n", "t.toml");
    EXPECT_FALSE(reader.has("methods"));
    EXPECT_FALSE(reader.has("sizes"));
    (void)reader.number("frames", 0, 9, 1);
    EXPECT_EQ(inputError([&] { reader.finish(); }),
              "t.toml:1: unknown key 'methdos' (did you mean 'methods'?); known: frames, methods, sizes");
}

TEST(TomlReader, LookingForAKeyDoesNotAllowIt) {
    auto reader = TomlReader::parseText("a = 1\n", "t.toml");
    EXPECT_TRUE(reader.has("a"));
    EXPECT_THAT(inputError([&] { reader.finish(); }), HasSubstr("unknown key 'a'"));
}

TEST(TomlReader, NamesTheLineOfASyntaxError) {
    EXPECT_THAT(inputError([] { TomlReader::parseText("a = 1\nb = = 2\n", "t.toml"); }),
                HasSubstr("t.toml:2: not valid"));
}

TEST(TomlText, IsReadBackAsItWas) {
    for (const std::string text : {"", "plain", "C:\\dust \"x\"", "line\nbreak\ttab\x7f", "ß…"}) {
        auto reader = TomlReader::parseText("a = " + tomlText(text) + "\n", "t");
        EXPECT_EQ(reader.text("a"), text);
    }
}

TEST(TomlReader, ReadsArraysOfTablesInOrder) {
    auto reader = TomlReader::parseText("[[p]]\nn = 'b'\n[[p]]\nn = 'a'\n", "t");
    std::vector<std::string> names;
    for (auto& table : reader.tables("p")) names.push_back(table.text("n"));
    EXPECT_THAT(names, ElementsAre("b", "a"));
}

TEST(TomlReader, ScalarsKeepTheirText) {
    auto reader = TomlReader::parseText("a = [100, 2.5, 'x', true]\nb = '1:9:2'\n", "t");
    EXPECT_THAT(reader.scalars("a"), ElementsAre("100", "2.5", "x", "on"));
    EXPECT_THAT(reader.scalars("b"), ElementsAre("1:9:2"));
}

}  // namespace
}  // namespace dustbench::files
