// Text made to fit a width: in one line, else in two, else in two of smaller letters, else cut.
//
// Letters are ASCII's. A few others that captions are likely to have are spelled with them (`×` is `x`, `–` is `-`,
// `…` is `...`), all further ones become `?`.
// Units: pixels. Threads: pure.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "bench/report/sheet/raster.h"

namespace dustbench::bench {

/// Letters shrink to this, and not further.
inline constexpr int minimumFontPixels = 8;

struct FittedText {
    std::vector<std::string> lines;  ///< none for text without letters, two at most
    Font font;

    [[nodiscard]] int width() const;   ///< of the widest line's ink
    [[nodiscard]] int height() const;  ///< of the lines with what is between them, whatever their letters
};

/// From the top of a line to that of the next.
[[nodiscard]] int linePitch(const Font& font);

/// `font` has the size that is wanted. Lines are broken between words, where there is more than one space if that fits,
/// then so that they are as even as can be. A line that does not fit at the minimum size ends in `...`.
[[nodiscard]] FittedText fitText(std::string_view text, int widthPixels, const Font& font);

/// Texts that stand for the same kind of thing, in letters of one size. One that needs less than two thirds of the size
/// wanted does not take the others along.
[[nodiscard]] std::vector<FittedText> fitAlike(const std::vector<std::string>& texts, int widthPixels,
                                               const Font& font);

/// The text as it will be drawn: in ASCII, without spaces at its ends; tabs and ends of lines are spaces.
[[nodiscard]] std::string drawableText(std::string_view text);

}  // namespace dustbench::bench
