// The contents of the sheet's SVG, and the picture that rsvg-convert makes from it; lines of text.
#include "bench/report/contact_sheet.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <regex>
#include <stdexcept>

#include "bench/export/whole_file.h"
#include "bench/measure/image/heat_map.h"
#include "bench/measure/image/resampled.h"
#include "bench/measure/image/test_images.h"
#include "bench/report/side_by_side_sheet.h"
#include "bench/results/temporary_folder.h"
#include "methods/kit/testing/test_input_error.h"

namespace dustbench::report {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

constexpr int tileWidth = 400, gap = 12, margin = 20;

pictures::Image plainPicture(int width, int height, glm::vec3 colour) {
    return measure::imageOf(width, height, [colour](int, int, int c) { return static_cast<double>(colour[c]); });
}

/// Waves whose phase identifies the picture.
pictures::Image wavyPicture(int width, int height, int number) {
    return measure::imageOf(width, height, [number](int x, int y, int c) {
        return 0.45 + 0.4 * std::sin(0.11 * x + 0.07 * y + 1.3 * number + 0.6 * c);
    });
}

/// 3 columns, 2 rows; one cell is left empty; every kind of text, and a scale.
ContactSheet fullSheet() {
    ContactSheet sheet;
    sheet.title = "Slalom, 15 m/s";
    sheet.columns = {"reference", "billboard", "FLIP of billboard"};
    sheet.rows = {"frame 48, 0.80 s", "frame 96, 1.60 s"};
    sheet.scale = SheetScale{0, 0.5f, "FLIP"};
    for (int row = 0; row < 2; ++row) {
        auto& cells = sheet.cells.emplace_back();
        for (int column = 0; column < 3; ++column)
            cells.push_back(SheetCell{wavyPicture(96, 72, 3 * row + column),
                                      column == 0 ? "" : "PSNR 38.2 dB  SSIM 0.994  FLIP 0.015"});
    }
    sheet.cells[1][2].reset();
    return sheet;
}

struct Box {
    int x = 0, y = 0, width = 0, height = 0;
};

/// Places of the pictures, in the order of the file. The last is the scale's bar if there is one.
std::vector<Box> picturesOf(const std::string& svg) {
    static const std::regex pattern("<image x=\"(\\d+)\" y=\"(\\d+)\" width=\"(\\d+)\" height=\"(\\d+)\"");
    std::vector<Box> boxes;
    for (std::sregex_iterator match(svg.begin(), svg.end(), pattern), end; match != end; ++match)
        boxes.push_back(
            {std::stoi((*match)[1]), std::stoi((*match)[2]), std::stoi((*match)[3]), std::stoi((*match)[4])});
    return boxes;
}

/// The lines of text, in the order of the file.
std::vector<std::string> textsOf(const std::string& svg) {
    static const std::regex pattern(R"(<text [^>]*>([^<]*)</text>)");
    std::vector<std::string> texts;
    for (std::sregex_iterator match(svg.begin(), svg.end(), pattern), end; match != end; ++match)
        texts.push_back((*match)[1]);
    return texts;
}

pictures::Image drawn(const std::string& svg) {
    const results::TemporaryFolder folder;
    exports::writeWhole(folder.path() / "contact_sheet.svg", svg);
    return pictures::readImage(drawContactSheet(folder.path()));
}

int inkedPixels(const pictures::Image& image, const Box& box) {
    int inked = 0;
    for (int y = box.y; y < box.y + box.height; ++y)
        for (int x = box.x; x < box.x + box.width; ++x) inked += image.at(x, y) != glm::vec4(1);
    return inked;
}

TEST(ContactSheet, HasTheSizeOfItsCells) {
    ContactSheet sheet;
    const auto sizeOf = [&](std::size_t rows, std::size_t columns) {
        sheet.cells.assign(rows, {columns, SheetCell{plainPicture(40, 30, glm::vec3(0.2f)), ""}});
        return contactSheetSvg(sheet);
    };
    EXPECT_THAT(sizeOf(1, 1), HasSubstr("width=\"440\" height=\"340\" viewBox=\"0 0 440 340\""));
    EXPECT_THAT(sizeOf(3, 2), HasSubstr("width=\"852\" height=\"964\" viewBox=\"0 0 852 964\""));
    const pictures::Image image = drawn(sizeOf(3, 2));
    EXPECT_EQ(std::pair(image.width, image.height), std::pair(852, 964));
}

TEST(ContactSheet, ShowsEveryPictureInItsPlaceToTheBit) {
    const ContactSheet sheet = fullSheet();
    const std::string svg = contactSheetSvg(sheet);
    const pictures::Image image = drawn(svg);
    const std::vector<Box> boxes = picturesOf(svg);
    ASSERT_EQ(boxes.size(), 6u);
    for (std::size_t i = 0; i < 5; ++i) {
        const Box& box = boxes[i];
        EXPECT_EQ(std::pair(box.width, box.height), std::pair(400, 300));
        EXPECT_EQ(box.x, boxes[0].x + static_cast<int>(i % 3) * (tileWidth + gap));
        EXPECT_EQ(box.y > boxes[0].y, i >= 3);
        const pictures::Image tile = measure::resampled(sheet.cells[i / 3][i % 3]->picture, 400, 300);
        for (int y = 0; y < 300; ++y)
            for (int x = 0; x < 400; ++x)
                for (int c = 0; c < 3; ++c)
                    ASSERT_NEAR(maths::encodeSrgb(image.at(box.x + x, box.y + y)[c]),
                                std::round(255 * maths::encodeSrgb(tile.at(x, y)[c])) / 255, 1e-5)
                        << i << ": " << x << " " << y;
    }
}

TEST(ContactSheet, ShowsPicturesAsADisplayDoes) {
    ContactSheet sheet;
    // A stripe far above white, such as the sun, and one below black; once in the tile's size, once twice as large.
    for (const int width : {400, 800}) {
        const auto stripes = measure::imageOf(width, width / 2, [&](int x, int, int) {
            return x < width / 3 ? 50.0 : x < 2 * width / 3 ? 0.25 : -3.0;
        });
        sheet.cells.push_back({SheetCell{stripes, ""}});
    }
    const std::string svg = contactSheetSvg(sheet);
    const pictures::Image image = drawn(svg);
    for (const Box& box : picturesOf(svg)) {
        const auto at = [&](int x) { return image.at(box.x + x, box.y + 60).r; };
        EXPECT_NEAR(at(60), 1, 1e-5);
        EXPECT_NEAR(at(200), 0.25, 2e-3);
        EXPECT_NEAR(at(340), 0, 1e-5);
        EXPECT_LT(at(133), 0.25 + 0.5 * (1 - 0.25) + 0.01) << "no more spills over the edge than would from white";
        EXPECT_GT(at(265), 0.5 * 0.25 - 0.01) << "nor than would from black";
    }
}

TEST(ContactSheet, KeepsTextBesidesPicturesAndInItsColumnHoweverLongItIs) {
    for (const std::string& caption :
         {std::string("PSNR 38.2 dB  SSIM 0.994  FLIP 0.015"), std::string(200, 'W'), std::string(200, 'i'),
          std::string("relief:height=0.25,steps=64,shadows=true")}) {
        ContactSheet sheet = fullSheet();
        for (auto& row : sheet.cells)
            for (auto& cell : row)
                if (cell) cell->caption = caption;
        sheet.columns[1] = caption + " as a heading";
        sheet.rows[0] = caption;
        const std::string svg = contactSheetSvg(sheet);
        const pictures::Image image = drawn(svg);
        const std::vector<Box> boxes = picturesOf(svg);
        const int above = boxes[0].y - 120, below = boxes.back().y;
        for (const int column : {0, 1, 2})
            EXPECT_EQ(inkedPixels(image, {boxes[0].x + column * (tileWidth + gap) - gap, std::max(above, 60), gap,
                                          below - std::max(above, 60)}),
                      0)
                << caption << " beside column " << column;
        EXPECT_EQ(inkedPixels(image, {0, 0, margin - 1, image.height}), 0);
        // Each picture is complete: nothing is drawn over it.
        const pictures::Image tile = measure::resampled(sheet.cells[1][1]->picture, 400, 300);
        for (int y = 0; y < 300; ++y)
            for (int x = 0; x < 400; ++x)
                ASSERT_NEAR(image.at(boxes[4].x + x, boxes[4].y + y).g, tile.at(x, y).g, 0.01) << x << " " << y;
    }
}

TEST(ContactSheet, BreaksRowHeadingsBetweenWords) {
    ContactSheet sheet = fullSheet();
    sheet.rows[0] = "octree_recursive of 2000 puffs";
    const std::string svg = contactSheetSvg(sheet);
    EXPECT_THAT(svg, HasSubstr(">octree_recursive<"));
    sheet.rows[0] = std::string(200, 'W');
    EXPECT_LT(picturesOf(contactSheetSvg(sheet))[0].x, 400);
}

TEST(ContactSheet, WritesEveryLetterOfItsTexts) {
    ContactSheet sheet = fullSheet();
    sheet.title = "a < b & \"c\" > d: λ=0.5 × 10⁻³";
    sheet.columns[1] = std::string(60, 'W');
    sheet.columns[2] = "bell\a and not UTF-8 \xff";
    const std::string svg = contactSheetSvg(sheet);
    const std::vector<std::string> texts = textsOf(svg);
    EXPECT_EQ(texts.front(), "a &lt; b &amp; &quot;c&quot; > d: λ=0.5 × 10⁻³");
    std::size_t letters = 0;
    for (const std::string& text : texts) letters += static_cast<std::size_t>(std::ranges::count(text, 'W'));
    EXPECT_EQ(letters, 60u);
    EXPECT_THAT(svg, HasSubstr("bell\\x07"));
    EXPECT_THAT(svg, HasSubstr("\\xff"));
    EXPECT_GT(inkedPixels(drawn(svg), {margin, margin, 300, 40}), 500) << "rsvg-convert reads it";
}

TEST(ContactSheet, DrawsInkOfEachLine) {
    const std::string svg = contactSheetSvg(fullSheet());
    const pictures::Image image = drawn(svg);
    const std::vector<Box> boxes = picturesOf(svg);
    EXPECT_THAT(textsOf(svg), testing::ElementsAre("Slalom, 15 m/s", "reference", "billboard", "FLIP of billboard",
                                                   "frame 48,", "0.80 s", "PSNR 38.2 dB  SSIM 0.994", "FLIP 0.015",
                                                   "PSNR 38.2 dB  SSIM 0.994", "FLIP 0.015", "frame 96,", "1.60 s",
                                                   "PSNR 38.2 dB  SSIM 0.994", "FLIP 0.015", "0", "FLIP", "0.5"));
    for (std::size_t i = 0; i < 3; ++i)
        EXPECT_GT(inkedPixels(image, {boxes[i].x, boxes[i].y - 40, tileWidth, 34}), 300) << "heading " << i;
    EXPECT_EQ(inkedPixels(image, {boxes[3].x, boxes[3].y + 301, tileWidth, 60}), 0) << "no caption";
    EXPECT_GT(inkedPixels(image, {boxes[4].x, boxes[4].y + 301, tileWidth, 35}), 300);
    EXPECT_GT(inkedPixels(image, {boxes[4].x, boxes[4].y + 336, tileWidth, 35}), 100);
    // Headings are centred over their pictures.
    int first = image.width, last = 0;
    for (int y = boxes[1].y - 40; y < boxes[1].y - 6; ++y)
        for (int x = boxes[1].x; x < boxes[1].x + tileWidth; ++x)
            if (image.at(x, y) != glm::vec4(1)) {
                first = std::min(first, x);
                last = std::max(last, x);
            }
    EXPECT_NEAR(first - boxes[1].x, boxes[1].x + tileWidth - 1 - last, 4);
}

TEST(ContactSheet, LeavesMissingCellsEmpty) {
    const std::string svg = contactSheetSvg(fullSheet());
    const std::vector<Box> boxes = picturesOf(svg);
    EXPECT_EQ(inkedPixels(drawn(svg), {boxes[2].x, boxes[4].y, tileWidth, 300 + 70}), 0);
}

TEST(ContactSheet, GivesTheScaleInTheHeatMapsColours) {
    const std::string svg = contactSheetSvg(fullSheet());
    const pictures::Image image = drawn(svg);
    const Box bar = picturesOf(svg).back();
    for (int x = 0; x < bar.width; ++x) {
        const glm::vec3 wanted = measure::heatColour((static_cast<float>(x) + 0.5f) / static_cast<float>(bar.width));
        for (int c = 0; c < 3; ++c) ASSERT_NEAR(image.at(bar.x + x, bar.y + 3)[c], wanted[c], 0.01);
    }
}

TEST(ContactSheet, TakesPicturesOfOneShapeInAnySize) {
    ContactSheet sheet;
    sheet.cells = {{SheetCell{plainPicture(64, 48, glm::vec3(0.1f)), ""}},
                   {SheetCell{plainPicture(640, 480, glm::vec3(0.3f)), ""}},
                   {SheetCell{plainPicture(16, 12, glm::vec3(0.6f)), ""}}};
    const std::string svg = contactSheetSvg(sheet);
    const pictures::Image image = drawn(svg);
    for (std::size_t i = 0; i < 3; ++i) {
        const Box box = picturesOf(svg)[i];
        for (const auto& [x, y] : {std::pair(0, 0), {399, 0}, {0, 299}, {399, 299}, {60, 45}})
            EXPECT_NEAR(image.at(box.x + x, box.y + y).g, (std::array{0.1f, 0.3f, 0.6f}[i]), 5e-3);
    }
}

TEST(ContactSheet, RefusesPicturesThatItCannotShow) {
    const auto with = [](const std::function<void(pictures::Image&)>& change) {
        return inputError([&] {
            ContactSheet sheet = fullSheet();
            change(sheet.cells[1][1]->picture);
            (void)contactSheetSvg(sheet);
        });
    };
    const std::string where = R"(contact sheet, row 2 ("frame 96, 1.60 s"), column 2 ("billboard"): )";
    EXPECT_EQ(with([](pictures::Image& p) { p = plainPicture(96, 70, glm::vec3(0)); }),
              where + "got a picture of 96x70, expected the shape of the first one, 96x72");
    EXPECT_EQ(with([](pictures::Image& p) { p = {}; }), where + "the picture has no pixels");
    EXPECT_EQ(with([](pictures::Image& p) { p.pixels[97].g = std::numeric_limits<float>::quiet_NaN(); }),
              where + "1 pixel is not finite, the first at (1, 1)");
    EXPECT_THAT(with([](pictures::Image& p) { p.pixels[5].a = 0.5f; }), HasSubstr(where + "1 pixel is not opaque"));
    EXPECT_THAT(with([](pictures::Image& p) { p.pixels.pop_back(); }), HasSubstr(where));
}

TEST(ContactSheet, RefusesWhatIsNoGrid) {
    const auto refused = [](const std::function<void(ContactSheet&)>& change) {
        ContactSheet sheet = fullSheet();
        change(sheet);
        EXPECT_THROW((void)contactSheetSvg(sheet), std::invalid_argument);
    };
    refused([](ContactSheet& s) { s.cells.clear(); });
    refused([](ContactSheet& s) { s.cells.assign(2, {}); });
    refused([](ContactSheet& s) { s.cells[1].pop_back(); });
    refused([](ContactSheet& s) { s.columns.pop_back(); });
    refused([](ContactSheet& s) { s.rows.emplace_back("one too many"); });
    refused([](ContactSheet& s) { s.scale->maximum = s.scale->minimum; });
    refused([](ContactSheet& s) { s.scale->maximum = std::numeric_limits<float>::quiet_NaN(); });
    refused([](ContactSheet& s) {
        for (auto& row : s.cells)
            for (auto& cell : row) cell.reset();
    });
}

TEST(ContactSheet, RefusesMoreThanCanBeDrawn) {
    ContactSheet sheet;
    sheet.cells.assign(1, {SheetCell{plainPicture(1, 100000, glm::vec3(0)), ""}});
    EXPECT_THAT(inputError([&] { (void)contactSheetSvg(sheet); }), HasSubstr("allowed: 32767 a side"));
}

// --- Lines of text

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
}  // namespace dustbench::report
