// Computes the layout of a contact sheet.
//
// Units: pixels. Frame: boxes from their upper left corner, y down. Boxes do not overlap and lie within the sheet.
// Threads: pure.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "bench/report/sheet/contact_sheet.h"
#include "bench/report/sheet/fitted_text.h"

namespace dustbench::bench {

struct SheetBox {
    int x = 0, y = 0, width = 0, height = 0;

    [[nodiscard]] int right() const { return x + width; }
    [[nodiscard]] int bottom() const { return y + height; }
};

enum class TextAlign { left, centre };

struct PlacedText {
    SheetBox box;  ///< maximum width of the text; all its ink is inside
    FittedText text;
    TextAlign align = TextAlign::left;
};

struct PlacedPicture {
    SheetBox box;
    std::size_t row = 0, column = 0;
};

struct SheetLayout {
    int width = 0, height = 0;
    std::vector<PlacedPicture> pictures;
    std::vector<PlacedText> texts;
    std::optional<SheetBox> bar;  ///< of the scale
};

/// Throws as drawSheet() does. Uses the sizes of the pictures, not their pixels.
[[nodiscard]] SheetLayout layOut(const ContactSheet& sheet, const SheetStyle& style);

/// `contact sheet, row 2 ("frame 48"), column 3 ("billboard")`: for messages.
[[nodiscard]] std::string cellName(const ContactSheet& sheet, std::size_t row, std::size_t column);

}  // namespace dustbench::bench
