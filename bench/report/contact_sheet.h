// A contact sheet: pictures in a grid with headings, captions and a colour bar, for use as a figure in a paper.
//
// White background, dark grey text in DejaVu Sans. Text wider than its column is broken into lines.
// Pictures are shown as on a display (clamped to [0, 1]), resampled in linear light to tiles 400 pixels wide.
//
// Units: pixels. Printed 17 cm wide, five columns have captions of 6 points. Threads: pure.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "methods/kit/pictures/image.h"

namespace dustbench::report {

struct SheetCell {
    pictures::Image picture;  ///< linear, opaque
    std::string caption;      ///< below the picture; may be empty. Two spaces mark the preferred line break
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

/// The sheet as SVG with its pictures embedded as PNG. Texts may contain any bytes (printable() is applied).
/// Throws InputError, with row and column, for pictures that differ in aspect ratio, are not finite or not opaque, and
/// for a sheet larger than `maximumSheetSide`. Throws std::invalid_argument if there are no cells, rows differ in
/// length, the number of headings differs from that of columns or rows, or the scale is empty.
[[nodiscard]] std::string contactSheetSvg(const ContactSheet& sheet);

inline constexpr int maximumSheetSide = 32'767;  ///< limit of rsvg-convert

// --- Lines of text, which another program draws

struct Lettering {
    double pixels = 28;  ///< nominal height
    bool bold = false;
};

/// Estimated from the advances of DejaVu Sans. Bold text is never wider than estimated.
[[nodiscard]] double textWidth(std::string_view text, const Lettering& lettering);

/// Breaks text into lines of at most `widthPixels`: first at two or more spaces, which mark the preferred place, then
/// between words, then within words. Blank text has no lines. `text` is UTF-8.
[[nodiscard]] std::vector<std::string> brokenText(std::string_view text, double widthPixels,
                                                  const Lettering& lettering);

}  // namespace dustbench::report
