// `run --video` and `--gif`, with a stand-in for ffmpeg.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "bench/cli/called_program.h"

namespace dustbench::cli {
namespace {

using testing::HasSubstr;
using testing::Not;

class Film : public Dustbench {
 protected:
    void SetUp() override {
        Dustbench::SetUp();
        const char* const path = std::getenv("PATH");
        path_ = path ? path : "";
    }
    void TearDown() override {
        setenv("PATH", path_.c_str(), 1);
        Dustbench::TearDown();
    }
    /// An ffmpeg that records its arguments and the pictures that it finds.
    void install(const std::string& last) const {
        const fs::path bin = folder_ / "bin";
        fs::create_directories(bin);
        std::ofstream(bin / "ffmpeg") << "#!/bin/sh\necho \"$@\" >> '" << (folder_ / "arguments").string()
                                      << "'\nfor last; do :; done\n"
                                      << last << "\n";
        fs::permissions(bin / "ffmpeg", fs::perms::owner_all);
        setenv("PATH", (bin.string() + ":" + path_).c_str(), 1);
    }
    [[nodiscard]] std::string file(const std::string& name) const { return (folder_ / name).string(); }

    std::string path_;
};

TEST_F(Film, IsMadeOfEveryPictureAfterTheRun) {
    install("echo film > \"$last\"");
    const Called called =
        shortRun("--frames 4 --video " + file("films/a.mp4") + " --gif " + file("a.gif") + " --out " + out());
    ASSERT_EQ(called.code, 0) << called.err;
    EXPECT_EQ(contentOf(folder_ / "films" / "a.mp4"), "film\n");
    EXPECT_EQ(contentOf(folder_ / "a.gif"), "film\n");
    const std::string arguments = contentOf(folder_ / "arguments");
    EXPECT_THAT(arguments, HasSubstr("-framerate 60/1 -pattern_type glob -i " +
                                     (runs(out()).at(0) / "images/f??????.png").string()));
    EXPECT_THAT(arguments, HasSubstr("palettegen"));
    for (int frame = 0; frame < 4; ++frame)
        EXPECT_TRUE(fs::exists(runs(out()).at(0) / "images" / fmt::format("f{:06}.png", frame)));
    for (const auto& entry : fs::directory_iterator(folder_ / "films")) EXPECT_EQ(entry.path().filename(), "a.mp4");
}

TEST_F(Film, OfEverySecondPictureHasHalfTheRate) {
    install("echo film > \"$last\"");
    const Called called = shortRun("--frames 4 --images 2 --gif " + file("a.gif") + " --out " + out());
    ASSERT_EQ(called.code, 0) << called.err;
    EXPECT_THAT(contentOf(folder_ / "arguments"), HasSubstr("-framerate 60/2 "));
}

TEST_F(Film, ThatFailsIsOneLineAndLeavesNothing) {
    install("echo half > \"$last\"; echo 'unknown encoder' >&2; exit 1");
    const Called called = shortRun("--frames 2 --video " + file("a.mp4") + " --out " + out());
    EXPECT_EQ(called.code, 3);
    EXPECT_THAT(called.err, HasSubstr("--video: ffmpeg: exit code 1: unknown encoder"));
    EXPECT_FALSE(fs::exists(folder_ / "a.mp4"));
    for (const auto& entry : fs::directory_iterator(folder_))
        EXPECT_THAT(entry.path().filename().string(), Not(HasSubstr("part")));
    EXPECT_EQ(runs(out()).size(), 1u);  // the run is kept
}

TEST_F(Film, IsRefusedBeforeTheRun) {
    install("");
    const std::vector<std::pair<std::string, std::string>> mistakes{
        {"--video x.avi", "--video: got 'x.avi', allowed: a .mp4"},
        {"--gif x.mp4", "--gif: got 'x.mp4', allowed: a .gif file"},
        {"--gif x.gif -P particles=100,200", "--gif: got 2 runs, allowed: 1"}};
    for (const auto& [options, expected] : mistakes) {
        const std::string command =
            "run --method " + methods().front().id + " --frames 2 " + options + " --out " + out();
        const Called called = call(command);
        EXPECT_EQ(called.code, 3) << called.err;
        EXPECT_THAT(called.err, HasSubstr(expected));
        EXPECT_EQ(std::ranges::count(called.err, '\n'), 1) << called.err;
    }
    setenv("PATH", folder_.c_str(), 1);
    const Called called = shortRun("--frames 2 --video a.mp4 --out " + out());
    EXPECT_EQ(called.code, 3);
    EXPECT_THAT(called.err, HasSubstr("--video: the program ffmpeg is not on the PATH"));
    EXPECT_FALSE(fs::exists(out()));
}

}  // namespace
}  // namespace dustbench::cli
