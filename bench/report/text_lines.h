// Breaks text into lines for pictures that another program draws.
//
// Widths are estimated from the advances of DejaVu Sans. Bold lines are never wider than estimated.
// Units: pixels. Threads: pure.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace dustbench::bench {

struct Lettering {
    double pixels = 28;  ///< nominal height
    bool bold = false;
};

[[nodiscard]] double textWidth(std::string_view text, const Lettering& lettering);

/// Breaks text into lines of at most `widthPixels`: first at two or more spaces, which mark the preferred place, then
/// between words, then within words. Blank text has no lines. `text` is UTF-8.
[[nodiscard]] std::vector<std::string> brokenText(std::string_view text, double widthPixels,
                                                  const Lettering& lettering);

}  // namespace dustbench::bench
