#include "bench/report/text_lines.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

namespace dustbench::bench {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

TEST(TextWidth, IsTheSumOfTheLettersAdvances) {
    EXPECT_DOUBLE_EQ(textWidth("", {100, false}), 0);
    EXPECT_DOUBLE_EQ(textWidth("0123456789", {100, false}), 636);
    EXPECT_DOUBLE_EQ(textWidth("@~ ", {100, false}), 100 + 83.8 + 31.8);
    EXPECT_DOUBLE_EQ(textWidth("λ", {100, false}), 100) << "one letter of two bytes";
    EXPECT_GT(textWidth("0", {100, true}), textWidth("0", {100, false}));
}

TEST(BrokenText, StaysInOneLineWhereItFits) {
    EXPECT_THAT(brokenText("", 100, {10, false}), IsEmpty());
    EXPECT_THAT(brokenText("   ", 100, {10, false}), IsEmpty());
    EXPECT_THAT(brokenText("PSNR 38.2 dB  FLIP 0.015", 200, {10, false}), ElementsAre("PSNR 38.2 dB  FLIP 0.015"));
}

TEST(BrokenText, IsBrokenAtWideSpacesThenBetweenWordsThenWithinThem) {
    const double twelve = 12 * 6.36;  // as wide as twelve digits
    EXPECT_THAT(brokenText("PSNR 38  SSIM 99  FLIP 0", twelve, {10, false}),
                ElementsAre("PSNR 38", "SSIM 99", "FLIP 0"));
    EXPECT_THAT(brokenText("111 222  333 444 555 666 777", twelve, {10, false}),
                ElementsAre("111 222", "333 444 555", "666 777"));
    EXPECT_THAT(brokenText("123456789012345 7", twelve, {10, false}), ElementsAre("123456789012", "345 7"));
}

TEST(BrokenText, LosesNoLetterAndMeetsTheWidth) {
    const std::string text = "octree_search:policy=accumulate,depth=11  αβγ δεζηθικλμνξοπρστυφχψω  WWWWWWWWWWWWW i";
    const auto without = [](const std::string& from) {
        std::string letters;
        for (const char letter : from)
            if (letter != ' ') letters += letter;
        return letters;
    };
    for (const double width : {1.0, 20.0, 40.0, 77.7, 150.0, 1000.0}) {
        std::string all;
        for (const std::string& line : brokenText(text, width, {10, true})) {
            EXPECT_LE(textWidth(line, {10, true}), std::max(width, 13.0)) << line;  // as wide as one letter
            all += line;
        }
        EXPECT_EQ(without(all), without(text)) << width;
    }
}

}  // namespace
}  // namespace dustbench::bench
