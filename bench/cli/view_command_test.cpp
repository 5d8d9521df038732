// `dustbench view` without a display.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "bench/cli/called_program.h"

namespace dustbench::cli {
namespace {

using testing::HasSubstr;

class ViewCommand : public Dustbench {
 protected:
    void SetUp() override {
        Dustbench::SetUp();
        unsetenv("DISPLAY");
        unsetenv("WAYLAND_DISPLAY");
    }
};

TEST_F(ViewCommand, WithoutADisplaySaysSoInOneLine) {
    const Called called = call("view");
    EXPECT_EQ(called.code, 3) << called.err;
    EXPECT_THAT(called.err, HasSubstr("view: "));
    EXPECT_EQ(std::ranges::count(called.err, '\n'), 1) << called.err;
    EXPECT_EQ(called.out, "");
}

TEST_F(ViewCommand, HelpListsTheKeys) {
    const Called called = call("view --help");
    EXPECT_EQ(called.code, 0) << called.err;
    for (const char* text : {"Ctrl+Q", "Space", "--with", "--picture", "--camera-path"})
        EXPECT_THAT(called.out, HasSubstr(text));
}

TEST_F(ViewCommand, WrongUseIsOneLineAndExitCodeThree) {
    const std::vector<std::pair<std::string, std::string>> mistakes{
        {"view --method bilboard", "unknown method"},
        {"view --with nothing", "unknown method"},
        {"view --method exact", "half A: got 'exact'"},
        {"view --state nowhere.toml", "nowhere.toml"},
        {"view -P particle=5", "'particles'"},
        {"view -P particles=5,6", "got 2 values"},
        {"view --frame -1", "--frame"},
        {"view --camera-path 0,1", "expected 8"},
        {"view --drive keybord", "'keybord'"},
        {"view --picture x.png --window 5", "WIDTHxHEIGHT"},
        {"view --picture x.png --show both", "--show: got 'both', allowed: A|B|wipe"},
        {"view --picture x.png --channel z", "--channel: got 'z', allowed: picture|alpha"}};
    for (const auto& [arguments, expected] : mistakes) {
        const Called called = call(arguments);
        EXPECT_EQ(called.code, 3) << arguments << "\n" << called.err;
        EXPECT_THAT(called.err, HasSubstr(expected)) << arguments;
        EXPECT_EQ(std::ranges::count(called.err, '\n'), 1) << arguments << "\n" << called.err;
    }
}

}  // namespace
}  // namespace dustbench::cli
