#include "bench/report/sheet/fitted_text.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "methods/contract/errors.h"

namespace dustbench::bench {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

const Font sans{"DejaVuSans", 20};

int widthOf(const std::string& text, int pixels = sans.pixels) {
    return inkExtent(text, {sans.name, pixels}).width();
}

std::string joined(const FittedText& text) {
    std::string all;
    for (const std::string& line : text.lines) all += (all.empty() ? "" : " ") + line;
    return all;
}

TEST(FittedText, StaysInOneLineWhereItFits) {
    const FittedText text = fitText("  two words ", widthOf("two words"), sans);
    EXPECT_THAT(text.lines, ElementsAre("two words"));
    EXPECT_EQ(text.font.pixels, sans.pixels);
    EXPECT_EQ(text.width(), widthOf("two words"));
    EXPECT_EQ(text.height(), lineExtent(sans).height());
}

TEST(FittedText, BreaksIntoTheTwoMaximumEvenLines) {
    const FittedText text = fitText("one of many long captions", widthOf("one of many long"), sans);
    EXPECT_THAT(text.lines, ElementsAre("one of many", "long captions"));
    EXPECT_EQ(text.font.pixels, sans.pixels);
    EXPECT_EQ(text.height(), lineExtent(sans).height() + linePitch(sans));
}

TEST(FittedText, BreaksAtWideSpacesFirst) {
    const FittedText text = fitText("PSNR 38.2 dB  SSIM 0.994  FLIP 0.015", widthOf("PSNR 38.2 dB  SSIM 0.994"), sans);
    EXPECT_THAT(text.lines, ElementsAre("PSNR 38.2 dB", "SSIM 0.994  FLIP 0.015"));
    // Where that does not fit, between any words: the names are long here, and only the middle will do.
    EXPECT_THAT(fitText("aaaa bbbb cccc  d", widthOf("aaaa bbbb") + 2, sans).lines,
                ElementsAre("aaaa bbbb", "cccc  d"));
}

TEST(FittedText, ShrinksOnlyAsFarAsItMust) {
    const std::string text = "improbablylong wordswithinit";
    const int room = widthOf("improbablylong") * 3 / 4;
    const FittedText fitted = fitText(text, room, sans);
    EXPECT_EQ(joined(fitted), text);
    EXPECT_LT(fitted.font.pixels, sans.pixels);
    EXPECT_LE(fitted.width(), room);
    EXPECT_GT(widthOf("improbablylong", fitted.font.pixels + 2), room);
}

TEST(FittedText, IsCutWhereEvenTheMinimumLettersDoNotFit) {
    for (const std::string& text : {std::string(300, 'W'), std::string(100000, 'i'), "a " + std::string(400, 'W')}) {
        const FittedText fitted = fitText(text, 100, sans);
        EXPECT_EQ(fitted.font.pixels, minimumFontPixels);
        EXPECT_LE(fitted.width(), 100);
        EXPECT_GE(fitted.width(), 80);
        EXPECT_TRUE(fitted.lines.back().ends_with("W...") || fitted.lines.back().ends_with("i..."));
    }
}

TEST(FittedText, FitsAnyWidthOfAnyText) {
    const std::string words = "FLIP 0.015 of  the octree, frame 48 (1.20 s) against j|y Q_g";
    for (std::size_t length = 1; length <= words.size(); length += 3)
        for (const int width : {16, 40, 95, 230, 700}) {
            const FittedText fitted = fitText(words.substr(0, length), width, sans);
            EXPECT_LE(fitted.width(), width) << length;
            EXPECT_LE(fitted.lines.size(), 2u);
        }
}

TEST(FittedText, HasOneSizeForTextsOfOneKind) {
    const std::string longer = "improbablylong wordswithinit";
    const int room = widthOf("improbablylong") * 9 / 10;
    const auto fitted = fitAlike({"short", longer, "", std::string(60, 'W')}, room, sans);
    ASSERT_EQ(fitted.size(), 4u);
    EXPECT_LT(fitted[1].font.pixels, sans.pixels);
    EXPECT_EQ(fitted[0].font.pixels, fitted[1].font.pixels);
    EXPECT_THAT(fitted[2].lines, IsEmpty());
    EXPECT_LT(fitted[3].font.pixels, fitted[1].font.pixels) << "the freak is smaller by itself";
    for (const FittedText& text : fitted) EXPECT_LE(text.width(), room);
}

TEST(DrawableText, SpellsWhatAsciiHasNotAndHidesNothing) {
    EXPECT_EQ(drawableText(" 640×480 – 3…4\t\"µ\"\r\n"), "640x480 - 3...4 \"u\"");
    EXPECT_EQ(drawableText("τ = 1, 粉塵 \U0001F697"), "? = 1, ?? ?");
    EXPECT_EQ(drawableText("a\xff\xc3"), "a??") << "not UTF-8";
    EXPECT_EQ(drawableText(" \n\t "), "");
}

TEST(Raster, InkLiesWithinItsExtent) {
    for (const std::string text : {"jgf|y", "  a ", "W", "PSNR 38.2 dB"})
        for (const int pixels : {7, 28, 90}) {
            const Font font{"DejaVuSans-Bold", pixels};
            const InkExtent extent = inkExtent(text, font), line = lineExtent(font);
            const Plane coverage = inkCoverage(text, font);
            EXPECT_EQ(coverage.width, extent.width());
            EXPECT_EQ(coverage.height, extent.height());
            // Nothing was cut off: the same ink is there with a wide margin around it.
            double sum = 0;
            for (const float value : coverage.values) {
                EXPECT_GE(value, 0);
                EXPECT_LE(value, 1);
                sum += static_cast<double>(value);
            }
            const Plane bounded = inkCoverage("|" + text + "|", font), bar = inkCoverage("|", font);
            double boundedSum = 0;
            for (const float value : bounded.values) boundedSum += static_cast<double>(value);
            for (const float value : bar.values) boundedSum -= 2 * static_cast<double>(value);
            EXPECT_NEAR(sum, boundedSum, 1e-3 * sum) << text;
            EXPECT_GT(sum, 0);
            EXPECT_GE(extent.top, line.top);
            EXPECT_LE(extent.bottom, line.bottom);
        }
}

TEST(Raster, TextWithoutInkIsEmpty) {
    EXPECT_EQ(inkExtent("", sans).width(), 0);
    EXPECT_THAT(inkCoverage("", sans).values, IsEmpty());
}

TEST(Raster, NamesAFontThatIsMissingAndThePackageThatBringsOne) {
    for (const std::string name : {"NoSuchFont", "/etc/hostname"}) try {
            (void)inkExtent("a", {name, 20});
            FAIL() << name;
        } catch (const InputError& error) {
            EXPECT_THAT(error.what(), HasSubstr("'" + name + "'"));
            EXPECT_THAT(error.what(), HasSubstr("fonts-dejavu-core"));
            EXPECT_THAT(error.what(), testing::Not(HasSubstr("\n")));
        }
}

}  // namespace
}  // namespace dustbench::bench
