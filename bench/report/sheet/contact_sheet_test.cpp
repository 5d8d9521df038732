#include "bench/report/sheet/contact_sheet.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <functional>
#include <limits>
#include <stdexcept>

#include "bench/measure/image/heat_map.h"
#include "bench/report/sheet/sheet_layout.h"
#include "bench/report/sheet/sheet_test_pictures.h"
#include "methods/kit/testing/test_input_error.h"

namespace dustbench::bench {
namespace {

using testing::HasSubstr;

bool contains(const SheetBox& box, int x, int y) {
    return x >= box.x && x < box.right() && y >= box.y && y < box.bottom();
}

bool overlap(const SheetBox& a, const SheetBox& b) {
    return a.x < b.right() && b.x < a.right() && a.y < b.bottom() && b.y < a.bottom();
}

std::vector<SheetBox> boxesOf(const SheetLayout& layout) {
    std::vector<SheetBox> boxes;
    boxes.reserve(layout.pictures.size() + layout.texts.size() + 1);
    for (const PlacedPicture& picture : layout.pictures) boxes.push_back(picture.box);
    for (const PlacedText& text : layout.texts) boxes.push_back(text.box);
    if (layout.bar) boxes.push_back(*layout.bar);
    return boxes;
}

const PlacedText& textOf(const SheetLayout& layout, const std::string& firstLine) {
    for (const PlacedText& text : layout.texts)
        if (text.text.lines.front() == firstLine) return text;
    throw std::out_of_range("no text that begins with " + firstLine);
}

/// Pixels of a box that differ from the paper.
int inkedPixels(const pictures::Image& image, const SheetBox& box) {
    int inked = 0;
    for (int y = box.y; y < box.bottom(); ++y)
        for (int x = box.x; x < box.right(); ++x) inked += image.at(x, y) != glm::vec4(1);
    return inked;
}

TEST(ContactSheet, HasTheSizeOfItsCells) {
    ContactSheet sheet;
    const auto sizeOf = [&](std::size_t rows, std::size_t columns, const SheetStyle& style) {
        const std::vector<std::optional<SheetCell>> row(columns, SheetCell{plainPicture(40, 30, glm::vec3(0.2f)), ""});
        sheet.cells.assign(rows, row);
        const pictures::Image image = drawSheet(sheet, style);
        EXPECT_EQ(image.pixels.size(), static_cast<std::size_t>(image.width * image.height));
        return std::pair(image.width, image.height);
    };
    const SheetStyle style = smallStyle();  // tiles of 120x90
    EXPECT_EQ(sizeOf(1, 1, style), std::pair(10 + 120 + 10, 10 + 90 + 10));
    EXPECT_EQ(sizeOf(1, 4, style), std::pair(10 + 4 * 120 + 3 * 6 + 10, 10 + 90 + 10));
    EXPECT_EQ(sizeOf(3, 2, style), std::pair(10 + 2 * 120 + 6 + 10, 10 + 3 * 90 + 2 * 6 + 10));
    EXPECT_EQ(SheetStyle{}.tileWidthPixels, 400);
    EXPECT_EQ(sizeOf(1, 1, {}), std::pair(400 + 2 * 20, 300 + 2 * 20));
}

TEST(ContactSheet, GrowsByWhatEachPartNeeds) {
    const ContactSheet whole = fullSheet();
    const auto sizeOf = [](const ContactSheet& sheet) { return layOut(sheet, smallStyle()); };
    const SheetLayout all = sizeOf(whole);
    const auto without = [&](const std::function<void(ContactSheet&)>& change) {
        ContactSheet sheet = whole;
        change(sheet);
        return sizeOf(sheet);
    };
    EXPECT_LT(without([](ContactSheet& s) { s.title = ""; }).height, all.height);
    EXPECT_LT(without([](ContactSheet& s) { s.columns.clear(); }).height, all.height);
    EXPECT_LT(without([](ContactSheet& s) { s.scale.reset(); }).height, all.height);
    EXPECT_LT(without([](ContactSheet& s) { s.rows.clear(); }).width, all.width);
    EXPECT_LT(without([](ContactSheet& s) {
                  for (auto& row : s.cells)
                      for (auto& cell : row)
                          if (cell) cell->caption = "";
              }).height,
              all.height);
    EXPECT_EQ(without([](ContactSheet& s) { s.rows.clear(); }).height, all.height);
}

TEST(ContactSheet, PlacesEverythingApartAndInside) {
    for (const SheetStyle& style : {SheetStyle{}, smallStyle()}) {
        ContactSheet sheet = fullSheet();
        sheet.rows[0] = "an exceedingly long heading of a row that is wider than its column";
        sheet.title += std::string(200, 'M');
        const SheetLayout layout = layOut(sheet, style);
        const auto boxes = boxesOf(layout);
        EXPECT_EQ(boxes.size(), 5u + 1 + 3 + 2 + 3 + 1 + 3);  // pictures, title, headings, captions, bar and its texts
        for (std::size_t i = 0; i < boxes.size(); ++i) {
            EXPECT_GE(boxes[i].x, style.marginPixels);
            EXPECT_GE(boxes[i].y, style.marginPixels);
            EXPECT_LE(boxes[i].right(), layout.width - style.marginPixels);
            EXPECT_LE(boxes[i].bottom(), layout.height - style.marginPixels);
            for (std::size_t j = 0; j < i; ++j) EXPECT_FALSE(overlap(boxes[i], boxes[j])) << i << " and " << j;
        }
    }
}

TEST(ContactSheet, HasRoomForItsScaleInTheNarrowestSheet) {
    for (const auto& [tile, font] : {std::pair(64, 16), {64, 6}, {300, 75}}) {
        ContactSheet sheet;
        sheet.cells = {{SheetCell{plainPicture(40, 30, glm::vec3(0.2f)), ""}}};
        sheet.scale = SheetScale{-1.2345e-5f, 1.5f, "a label of many words that no sheet as narrow has room for"};
        SheetStyle style;
        style.tileWidthPixels = tile;
        style.fontPixels = font;
        const SheetLayout layout = layOut(sheet, style);
        ASSERT_EQ(layout.texts.size(), 3u);
        EXPECT_GE(layout.bar->width, tile / 6);
        EXPECT_GE(layout.texts[0].box.x, style.marginPixels);
        EXPECT_LE(layout.texts[0].box.right(), layout.texts[1].box.x);
        EXPECT_LT(layout.texts[1].box.right(), layout.bar->x);
        EXPECT_LT(layout.bar->right(), layout.texts[2].box.x);
        EXPECT_LE(layout.texts[2].box.right(), layout.width - style.marginPixels);
    }
}

TEST(ContactSheet, ShowsEveryPictureInItsPlace) {
    const ContactSheet sheet = fullSheet();
    const pictures::Image image = drawSheet(sheet, smallStyle());
    const SheetLayout layout = layOut(sheet, smallStyle());
    ASSERT_EQ(layout.pictures.size(), 5u);
    for (const PlacedPicture& placed : layout.pictures) {
        EXPECT_EQ(placed.box.width, 120);
        EXPECT_EQ(placed.box.height, 90);
        // Rows go down, columns to the right.
        EXPECT_EQ(placed.box.x, layout.pictures[0].box.x + static_cast<int>(placed.column) * (120 + 6));
        EXPECT_EQ(placed.box.y > layout.pictures[0].box.y, placed.row > 0);
        const pictures::Image tile = resampled(sheet.cells[placed.row][placed.column]->picture, 120, 90);
        for (int y = 0; y < 90; ++y)
            for (int x = 0; x < 120; ++x) {
                const glm::vec4 found = image.at(placed.box.x + x, placed.box.y + y), wanted = tile.at(x, y);
                for (int c = 0; c < 4; ++c) ASSERT_NEAR(found[c], wanted[c], 1e-5) << x << " " << y;
            }
    }
}

TEST(ContactSheet, ShowsPicturesAsADisplayDoes) {
    ContactSheet sheet;
    // A stripe far above white, as the sun is, and one below black; once of the tile's own size, once twice as large.
    for (const int width : {120, 240}) {
        const auto stripes = imageOf(width, width, [&](int x, int, int) {
            return x < width / 3 ? 50.0 : x < 2 * width / 3 ? 0.25 : -3.0;
        });
        sheet.cells.push_back({SheetCell{stripes, ""}});
    }
    const pictures::Image image = drawSheet(sheet, smallStyle());
    for (const PlacedPicture& placed : layOut(sheet, smallStyle()).pictures) {
        const auto at = [&](int x) { return image.at(placed.box.x + x, placed.box.y + 60).r; };
        EXPECT_NEAR(at(20), 1, 1e-5);
        EXPECT_NEAR(at(60), 0.25, 1e-5);
        EXPECT_NEAR(at(100), 0, 1e-5);
        EXPECT_LT(at(40), 0.25 + 0.5 * (1 - 0.25)) << "no more spills over the edge than would from white";
        EXPECT_GT(at(79), 0.5 * 0.25) << "nor than would from black";
    }
    for (const glm::vec4& pixel : image.pixels) ASSERT_TRUE(pixel.a == 1 && pixel.r >= 0 && pixel.r <= 1);
}

TEST(ContactSheet, DarkensNothingButItsBoxes) {
    const ContactSheet sheet = fullSheet();
    const pictures::Image image = drawSheet(sheet, smallStyle());
    const SheetLayout layout = layOut(sheet, smallStyle());
    auto boxes = boxesOf(layout);
    const int outline = 1;
    boxes.back() = {layout.bar->x - outline, layout.bar->y - outline, layout.bar->width + 2 * outline,
                    layout.bar->height + 2 * outline};
    for (int y = 0; y < image.height; ++y)
        for (int x = 0; x < image.width; ++x) {
            const bool inside =
                std::any_of(boxes.begin(), boxes.end(), [&](const SheetBox& box) { return contains(box, x, y); });
            ASSERT_TRUE(inside || image.at(x, y) == glm::vec4(1)) << x << " " << y;
        }
    for (const PlacedText& text : layout.texts) {
        const int inked = inkedPixels(image, text.box), whole = text.box.width * text.box.height;
        EXPECT_GT(inked, 20) << text.text.lines.front();
        EXPECT_LT(inked, whole * 3 / 5) << text.text.lines.front();
        float darkest = 1;
        for (int y = text.box.y; y < text.box.bottom(); ++y)
            for (int x = text.box.x; x < text.box.right(); ++x) {
                const glm::vec4 pixel = image.at(x, y);
                EXPECT_TRUE(pixel.r == pixel.g && pixel.g == pixel.b && pixel.a == 1);
                darkest = std::min(darkest, pixel.r);
            }
        EXPECT_NEAR(darkest, maths::decodeSrgb(0.15f), 0.02) << "as dark as the ink: " << text.text.lines.front();
    }
}

TEST(ContactSheet, DrawsAllInkOfEachLine) {
    // Ink that is cut off at a box would be missing from the sheet.
    const ContactSheet sheet = fullSheet();
    const pictures::Image image = drawSheet(sheet, smallStyle());
    for (const PlacedText& text : layOut(sheet, smallStyle()).texts) {
        double wanted = 0, found = 0;
        for (const std::string& line : text.text.lines)
            for (const float share : inkCoverage(line, text.text.font).values) wanted += static_cast<double>(share);
        for (int y = text.box.y; y < text.box.bottom(); ++y)
            for (int x = text.box.x; x < text.box.right(); ++x)
                found += static_cast<double>((1 - maths::encodeSrgb(image.at(x, y).r)) / 0.85f);
        EXPECT_NEAR(found, wanted, 1e-3 * wanted) << text.text.lines.front();
    }
}

TEST(ContactSheet, KeepsCaptionsInTheirColumnHoweverLongTheyAre) {
    for (const std::string& caption :
         {std::string("PSNR 38.2 dB  SSIM 0.994  FLIP 0.015"), std::string(500, 'W'), std::string("two words")}) {
        ContactSheet sheet = fullSheet();
        for (auto& row : sheet.cells)
            for (auto& cell : row)
                if (cell) cell->caption = caption;
        sheet.columns[1] = caption + " as a heading";
        const pictures::Image image = drawSheet(sheet, smallStyle());
        const SheetLayout layout = layOut(sheet, smallStyle());
        const PlacedPicture& first = layout.pictures[0];
        for (int gap = 1; gap <= 2; ++gap)
            for (int x = 0; x < 6; ++x)
                for (int y = first.box.y - 30; y < layout.bar->y - 10; ++y)
                    ASSERT_EQ(image.at(first.box.x + gap * 126 - 6 + x, y), glm::vec4(1)) << x << " " << y;
    }
}

TEST(ContactSheet, LeavesMissingCellsEmpty) {
    const ContactSheet sheet = fullSheet();
    const pictures::Image image = drawSheet(sheet, smallStyle());
    const SheetLayout layout = layOut(sheet, smallStyle());
    const SheetBox above = layout.pictures[2].box, left = layout.pictures[4].box;
    EXPECT_EQ(inkedPixels(image, {above.x, left.y, above.width, left.height + 30}), 0);
}

TEST(ContactSheet, CentresTextOverAndUnderPictures) {
    const ContactSheet sheet = fullSheet();
    const pictures::Image image = drawSheet(sheet, smallStyle());
    const SheetLayout layout = layOut(sheet, smallStyle());
    const PlacedText& heading = textOf(layout, "reference");
    EXPECT_EQ(heading.box.x, layout.pictures[0].box.x);
    EXPECT_LT(heading.box.bottom(), layout.pictures[0].box.y);
    int first = image.width, last = 0;
    for (int y = heading.box.y; y < heading.box.bottom(); ++y)
        for (int x = heading.box.x; x < heading.box.right(); ++x)
            if (image.at(x, y) != glm::vec4(1)) {
                first = std::min(first, x);
                last = std::max(last, x);
            }
    EXPECT_NEAR(first - heading.box.x, heading.box.right() - 1 - last, 2);
}

TEST(ContactSheet, GivesTheScaleInTheHeatMapsColours) {
    const ContactSheet sheet = fullSheet();
    const pictures::Image image = drawSheet(sheet, smallStyle());
    const SheetLayout layout = layOut(sheet, smallStyle());
    ASSERT_TRUE(layout.bar);
    for (int x = 0; x < layout.bar->width; ++x) {
        const glm::vec3 wanted = heatColour((static_cast<float>(x) + 0.5f) / static_cast<float>(layout.bar->width));
        for (int y = 0; y < layout.bar->height; ++y)
            ASSERT_EQ(glm::vec3(image.at(layout.bar->x + x, layout.bar->y + y)), wanted);
    }
    EXPECT_LT(textOf(layout, "FLIP").box.right(), textOf(layout, "0").box.x);
    EXPECT_LT(textOf(layout, "0").box.right(), layout.bar->x);
    EXPECT_GT(textOf(layout, "0.5").box.x, layout.bar->right());
}

TEST(ContactSheet, TakesPicturesOfOneShapeInAnySize) {
    ContactSheet sheet;
    sheet.cells = {{SheetCell{plainPicture(64, 48, glm::vec3(0.1f)), ""}},
                   {SheetCell{plainPicture(640, 480, glm::vec3(0.3f)), ""}},
                   {SheetCell{plainPicture(16, 12, glm::vec3(0.6f)), ""}}};
    const pictures::Image image = drawSheet(sheet, smallStyle());
    const SheetLayout layout = layOut(sheet, smallStyle());
    for (std::size_t i = 0; i < 3; ++i) {
        const SheetBox& box = layout.pictures[i].box;
        const float wanted = std::array{0.1f, 0.3f, 0.6f}[i];
        for (const auto& [x, y] : {std::pair(0, 0), {119, 0}, {0, 89}, {119, 89}, {60, 45}})
            EXPECT_NEAR(image.at(box.x + x, box.y + y).g, wanted, 1e-5);
    }
}

TEST(ContactSheet, RefusesPicturesThatItCannotShow) {
    const auto with = [](const std::function<void(pictures::Image&)>& change) {
        return inputError([&] {
            ContactSheet sheet = fullSheet();
            change(sheet.cells[1][1]->picture);
            (void)drawSheet(sheet, smallStyle());
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
        EXPECT_THROW((void)drawSheet(sheet, smallStyle()), std::invalid_argument);
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

TEST(ContactSheet, RefusesStylesAndSizesOutOfRange) {
    const auto refused = [](const std::function<void(SheetStyle&)>& change) {
        SheetStyle style = smallStyle();
        change(style);
        EXPECT_THROW((void)drawSheet(fullSheet(), style), std::invalid_argument);
    };
    refused([](SheetStyle& s) { s.tileWidthPixels = 63; });
    refused([](SheetStyle& s) { s.fontPixels = 5; });
    refused([](SheetStyle& s) { s.fontPixels = 31; });
    refused([](SheetStyle& s) { s.marginPixels = -1; });
    refused([](SheetStyle& s) { s.gapPixels = -1; });

    ContactSheet sheet = fullSheet();
    SheetStyle style = smallStyle();
    style.font = "NoSuchFont";
    EXPECT_THAT(inputError([&] { (void)drawSheet(sheet, style); }), HasSubstr("'NoSuchFont'"));

    sheet = {};
    sheet.cells.assign(1, {SheetCell{plainPicture(1, 100000, glm::vec3(0)), ""}});
    style = {};
    style.tileWidthPixels = 8192;
    EXPECT_THAT(inputError([&] { (void)drawSheet(sheet, style); }), HasSubstr("allowed: 134 million"));
}

TEST(Resampled, AveragesInLinearLight) {
    // Stripes of black and white, two pixels each, made four times as narrow: half of white's light everywhere.
    const auto stripes = imageOf(256, 64, [](int x, int, int) { return x / 2 % 2 == 0 ? 1.0 : 0.0; });
    const pictures::Image half = resampled(stripes, 32, 8);
    for (int y = 0; y < 8; ++y)
        for (int x = 2; x < 30; ++x) EXPECT_NEAR(half.at(x, y).g, 0.5, 0.02) << x;
}

TEST(Resampled, StaysWithinTheImagesRangeAndPlace) {
    const auto edge = imageOf(200, 150, [](int x, int y, int) { return x >= 100 && y >= 75 ? 0.9 : 0.05; });
    for (const auto& [width, height] : {std::pair(80, 60), {128, 96}, {400, 300}}) {
        const pictures::Image image = resampled(edge, width, height);
        for (const glm::vec4& pixel : image.pixels) {
            ASSERT_GE(pixel.r, 0.05f - 1e-5f);
            ASSERT_LE(pixel.r, 0.9f + 1e-5f);
        }
        // The edge is where it was: at its middle the value is half way.
        const float before = image.at(width / 2 - 1, height - 2).r, after = image.at(width / 2, height - 2).r;
        EXPECT_NEAR((before + after) / 2, (0.05 + 0.9) / 2, 0.01);
        EXPECT_LT(before, after);
    }
    EXPECT_EQ(resampled(edge, 200, 150).pixels, edge.pixels);
}

}  // namespace
}  // namespace dustbench::bench
