// Fits text to a width: in one line, else in two, else in two with smaller letters, else truncated.
//
// Characters are ASCII. A few others that are likely in captions are transliterated (`×` to `x`, `–` to `-`, `…` to
// `...`); all others become `?`.
// Units: pixels. Threads: pure.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "bench/report/sheet/raster.h"

namespace dustbench::bench {

/// Minimum size to which letters shrink.
inline constexpr int minimumFontPixels = 8;

struct FittedText {
    std::vector<std::string> lines;  ///< at most two; none for empty text
    Font font;

    [[nodiscard]] int width() const;   ///< of the widest line's ink
    [[nodiscard]] int height() const;  ///< of the lines with the space between them, independent of their letters
};

/// Distance between the tops of consecutive lines.
[[nodiscard]] int linePitch(const Font& font);

/// `font` has the preferred size. Lines are broken between words, preferably at more than one space, then as evenly as
/// possible. A line that does not fit at the minimum size ends in `...`.
[[nodiscard]] FittedText fitText(std::string_view text, int widthPixels, const Font& font);

/// Fits texts of the same kind in letters of one size. A text that needs less than two thirds of the preferred size
/// does not shrink the others.
[[nodiscard]] std::vector<FittedText> fitAlike(const std::vector<std::string>& texts, int widthPixels,
                                               const Font& font);

/// The text as drawn: ASCII, trimmed; tabs and line ends become spaces.
[[nodiscard]] std::string drawableText(std::string_view text);

}  // namespace dustbench::bench
