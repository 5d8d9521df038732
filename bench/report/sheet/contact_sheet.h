// A contact sheet: pictures in a grid with headings, captions and a colour bar, for use as a figure in a paper.
//
// White paper, dark grey text. Pictures are shown as on a display (clamped to [0, 1]) and resampled in linear light.
// Text is drawn at its final size; text too wide for its column is broken into two lines, and shrunk if that is not
// enough (fitted_text.h, which also lists the supported characters).
//
// Units: pixels; the sheet is linear light, opaque. Printed 17 cm wide, five columns of the default style have captions
// of 6 points. Threads: pure.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "methods/kit/pictures/image.h"

namespace dustbench::bench {

struct SheetCell {
    pictures::Image picture;  ///< linear, opaque
    std::string caption;      ///< below it, may be empty. Two spaces mark the preferred line break
};

/// A bar with heatColour() from left to right: the scale of heatMap(…, minimum, maximum).
struct SheetScale {
    float minimum = 0;
    float maximum = 1;
    std::string label;  ///< left of it: "FLIP"
};

struct ContactSheet {
    std::string title;                                         ///< at the top; empty: none
    std::vector<std::string> columns;                          ///< headings, one per column; empty: no headings
    std::vector<std::string> rows;                             ///< at the left, one per row; empty: none
    std::vector<std::vector<std::optional<SheetCell>>> cells;  ///< [row][column]; nullopt: left empty
    std::optional<SheetScale> scale;
};

struct SheetStyle {
    int tileWidthPixels = 400;
    int fontPixels = 28;    ///< of captions and headings; the title is a sixth larger
    int marginPixels = 20;  ///< around the sheet
    int gapPixels = 12;     ///< between pictures
    std::string font = "DejaVuSans";
    std::string boldFont = "DejaVuSans-Bold";  ///< of the title and the headings of columns
};

/// Throws InputError for pictures of different aspect, non-finite or not opaque (with row and column), for a font that
/// is not installed, and for a sheet of over `maximumSheetPixels`; std::invalid_argument for ragged or no cells, a
/// number of headings that differs from that of columns or rows, a scale without extent, and a style out of range.
[[nodiscard]] pictures::Image drawSheet(const ContactSheet& sheet, const SheetStyle& style = {});

inline constexpr long long maximumSheetPixels = 1LL << 27;  ///< 2 GiB in memory

}  // namespace dustbench::bench
