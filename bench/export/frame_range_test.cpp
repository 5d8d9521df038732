#include "bench/export/frame_range.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "methods/kit/testing/test_folder.h"

namespace dustbench::bench {
namespace {

std::vector<std::int64_t> framesOf(const std::string& text) {
    const FrameRange range = parseFrameRange("--frames", text);
    std::vector<std::int64_t> frames;
    for (std::int64_t frame = 0; frame < 100; ++frame)
        if (range.contains(frame)) frames.push_back(frame);
    EXPECT_EQ(range.count(), static_cast<std::int64_t>(frames.size())) << text;
    EXPECT_EQ(range.last, frames.back()) << text;
    return frames;
}

TEST(FrameRange, LeavesOutItsEnd) {
    EXPECT_THAT(framesOf("0:10:5"), testing::ElementsAre(0, 5));
    EXPECT_THAT(framesOf("0:11:5"), testing::ElementsAre(0, 5, 10));
    EXPECT_THAT(framesOf("3:6"), testing::ElementsAre(3, 4, 5));
    EXPECT_THAT(framesOf("7"), testing::ElementsAre(7));
    EXPECT_THAT(framesOf("7:8:1000"), testing::ElementsAre(7));
}

TEST(FrameRange, HasOneTextForTheSameFrames) {
    EXPECT_EQ(parseFrameRange("", "0:10:4").text(), parseFrameRange("", "0:9:4").text());
    EXPECT_EQ(parseFrameRange("", "5").text(), parseFrameRange("", "5:7:9").text());
    for (const char* text : {"0:10:5", "3:6", "7", "2:90:11"}) {
        const FrameRange range = parseFrameRange("", text);
        EXPECT_EQ(framesOf(range.text()), framesOf(text));
    }
}

TEST(FrameRange, RefusesWhatHoldsNoFrameInOneLine) {
    for (const char* text : {"", "a", "1:", ":5", "1:5:", "1:2:3:4", "-1", "-5:5", "1:-5", "5:1", "5:1:2", "5:5",
                             "0:5:0", "0:5:-1", "1.5", "1 :5", "0:99999999999", "99999999999999999999", "0x10"})
        EXPECT_THAT(inputError([&] { (void)parseFrameRange("--frames", text); }),
                    testing::AllOf(testing::StartsWith("--frames: got '" + std::string(text) + "'"),
                                   testing::HasSubstr("allowed: A:B:STEP")))
            << text;
}

}  // namespace
}  // namespace dustbench::bench
