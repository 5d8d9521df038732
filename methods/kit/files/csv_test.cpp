#include "methods/kit/files/csv.h"

#include <gtest/gtest.h>

#include <limits>

#include "methods/contract/errors.h"

namespace dustbench::files {
namespace {

TEST(Csv, ReadsQuotedCellsWithCommasQuotesAndLineEnds) {
    const auto table = CsvTable::parseText("a,b\r\n\"x,\"\"y\"\"\",1\r\n\"two\nlines\",2\n", "t");
    EXPECT_EQ(table.rows(), 2u);
    EXPECT_EQ(table.cell(0, "a"), "x,\"y\"");
    EXPECT_EQ(table.cell(1, "a"), "two\nlines");
    EXPECT_EQ(table.number(1, "b"), 2);
}

TEST(Csv, OtherSeparatorsAndUtf16AreNamed) {
    const auto refusal = [](std::string_view text) {
        try {
            (void)CsvTable::parseText(text, "t");
        } catch (const InputError& error) {
            return std::string(error.what());
        }
        return std::string();
    };
    const std::string commas = ", expected commas, and decimal points in numbers (1.5, not 1,5)";
    EXPECT_EQ(refusal("time_s;steer\n0;0\n1,5;0\n"), "t:1: cells are separated by semicolons" + commas);
    EXPECT_EQ(refusal("x\ty\n1\t2\n"), "t:1: cells are separated by tabs" + commas);
    EXPECT_EQ(refusal(std::string_view("\xFF\xFEx\0,\0y\0", 8)), "t: the file is in UTF-16, expected UTF-8");
    EXPECT_EQ(refusal(std::string_view("\xFE\xFF\0x\0,\0y", 8)), "t: the file is in UTF-16, expected UTF-8");
    EXPECT_EQ(refusal("x\n1\n"), "");
}

TEST(Csv, WrittenCellsReadBackTheSame) {
    for (const std::string text : {"plain", "a,b", "say \"so\"", "two\nlines", "", " spaced "}) {
        const auto table = CsvTable::parseText("h,k\n" + csvCell(text) + ",1\n", "t");
        EXPECT_EQ(table.cell(0, "h"), text);
    }
}

TEST(Csv, WrittenNumbersReadBackTheSame) {
    for (const double value : {0.1, -1e-300, 16777217.0, 1.0 / 3}) {
        const auto table = CsvTable::parseText("h\n" + csvNumber(value) + "\n", "t");
        EXPECT_EQ(table.number(0, "h"), value);
    }
    EXPECT_EQ(csvNumber(std::numeric_limits<double>::quiet_NaN()), "");
}

TEST(Csv, NumbersMayBeTinyButMustBeNumbers) {
    for (const double value : {1e-310, 5e-324, -1e-310, 1e308}) EXPECT_EQ(numberOf(csvNumber(value)), value);
    for (const char* text : {"", "abc", "1 ", " 1", "nan", "inf", "-inf", "1e999", "0x10", "true"})
        EXPECT_FALSE(numberOf(text)) << text;
}

TEST(Csv, NamesTheLineOfWhatIsWrong) {
    const auto messageOf = [](const char* text, auto action) {
        try {
            action(CsvTable::parseText(text, "d.csv"));
        } catch (const InputError& error) {
            return std::string(error.what());
        }
        return std::string("no error");
    };
    const auto nothing = [](const CsvTable&) {};
    EXPECT_EQ(messageOf("", nothing), "d.csv:1: the file is empty, expected a header line");
    EXPECT_EQ(messageOf("a,b\n1,2\n3\n", nothing), "d.csv:3: got 1 cells, expected 2 as in the header");
    EXPECT_EQ(messageOf("a\n\"open\n", nothing), "d.csv:2: a quote is not closed");
    EXPECT_EQ(messageOf("a\n1\nx\n", [](const CsvTable& t) { (void)t.number(1, "a"); }),
              "d.csv:3: column 'a': got 'x', expected a number");
    EXPECT_EQ(messageOf("a\n1\n", [](const CsvTable& t) { (void)t.number(0, "b"); }), "d.csv:1: column 'b' is missing");
    EXPECT_EQ(messageOf("a\nnan\n", [](const CsvTable& t) { (void)t.number(0, "a"); }),
              "d.csv:2: column 'a': got 'nan', expected a number");
}

}  // namespace
}  // namespace dustbench::files
