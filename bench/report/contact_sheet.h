// A contact sheet: pictures in a grid with headings, captions and a colour bar, for use as a figure in a paper.
//
// White paper, dark grey text in DejaVu Sans; text too wide for its column is broken into lines (text_lines.h).
// Pictures are shown as on a display (clamped to [0, 1]), resampled in linear light to tiles 400 pixels wide.
//
// Units: pixels. Printed 17 cm wide, five columns have captions of 6 points. Threads: pure.
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
    std::string label;  ///< below it: "FLIP"
};

struct ContactSheet {
    std::string title;                                         ///< at the top; empty: none
    std::vector<std::string> columns;                          ///< headings, one per column; empty: no headings
    std::vector<std::string> rows;                             ///< at the left, one per row; empty: none
    std::vector<std::vector<std::optional<SheetCell>>> cells;  ///< [row][column]; nullopt: left empty
    std::optional<SheetScale> scale;
};

/// The sheet as SVG, its pictures embedded as PNG. Texts may hold any bytes (printable() is applied).
/// Throws InputError for pictures of different aspect, non-finite or not opaque (with row and column), and for a sheet
/// of over `maximumSheetSide`; std::invalid_argument for ragged or no cells, a number of headings that differs from
/// that of columns or rows, and a scale without extent.
[[nodiscard]] std::string contactSheetSvg(const ContactSheet& sheet);

inline constexpr int maximumSheetSide = 32'767;  ///< of what rsvg-convert draws

}  // namespace dustbench::bench
