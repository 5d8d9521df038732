#include "bench/run/run_messages.h"

#include <gtest/gtest.h>

namespace dustbench::run {
namespace {

std::string_view withoutEnd(const std::string& line) {
    EXPECT_TRUE(line.ends_with('\n') && line.find('\n') == line.size() - 1) << line;
    return std::string_view(line).substr(0, line.size() - 1);
}

TEST(RunMessages, ErrorsOfEveryKindAreReadAsWritten) {
    using Kind = RunError::Kind;
    for (const Kind kind : {Kind::input, Kind::run, Kind::machine, Kind::memory, Kind::internal})
        for (const char* message : {"out of memory", "", "error input x", "a  b"}) {
            const std::string line = lineOf(RunError{kind, message});
            const auto read = errorIn(withoutEnd(line));
            ASSERT_TRUE(read) << line;
            EXPECT_EQ(read->kind, kind);
            EXPECT_EQ(read->message, message);
        }
}

TEST(RunMessages, AnErrorIsOneLine) {
    const std::string line = lineOf(RunError{RunError::Kind::input, "a\nb\x1b[0m"});
    EXPECT_EQ(errorIn(withoutEnd(line))->message, "a b\\x1b[0m");
}

TEST(RunMessages, ForecastsAreReadAsWritten) {
    const std::string line = lineOf(RunForecast{3.25, 0.5});
    const auto read = forecastIn(withoutEnd(line));
    ASSERT_TRUE(read);
    EXPECT_DOUBLE_EQ(read->measuring, 3.25);
    EXPECT_DOUBLE_EQ(read->metricPlan, 0.5);
}

TEST(RunMessages, OtherLinesAreNeither) {
    EXPECT_EQ(lineOf("frames", 12, 120), "frames 12 120\n");
    for (const char* line : {"", "frames 12 120", "error", "error ", "error unknown x", "errors input x", "forecast",
                             "forecast a b", "forecast 3"}) {
        EXPECT_FALSE(errorIn(line)) << line;
        EXPECT_FALSE(forecastIn(line)) << line;
    }
}

}  // namespace
}  // namespace dustbench::run
