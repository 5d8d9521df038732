#include "bench/report/sheet/fitted_text.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>

namespace dustbench::bench {
namespace {

/// Longer text is cut before measuring: no sheet has room for it.
constexpr std::size_t maximumLetters = 500;
constexpr std::string_view cutMark = "...";

constexpr std::array<std::pair<std::string_view, std::string_view>, 12> spellings{{{"×", "x"},
                                                                                   {"–", "-"},
                                                                                   {"—", "-"},
                                                                                   {"−", "-"},
                                                                                   {"…", "..."},
                                                                                   {"·", "."},
                                                                                   {"‘", "'"},
                                                                                   {"’", "'"},
                                                                                   {"“", "\""},
                                                                                   {"”", "\""},
                                                                                   {"µ", "u"},
                                                                                   {"\u00a0", " "}}};

bool isContinuation(char byte) {
    return (static_cast<unsigned char>(byte) & 0xC0u) == 0x80u;
}

/// The transliteration of the non-ASCII character at the start of `text`, and its length in bytes.
std::pair<std::string_view, std::size_t> spelled(std::string_view text) {
    for (const auto& [letter, spelling] : spellings)
        if (text.starts_with(letter)) return {spelling, letter.size()};
    std::size_t bytes = 1;
    while (bytes < text.size() && bytes < 4 && isContinuation(text[bytes])) ++bytes;
    return {"?", bytes};
}

int widthOf(const std::string& line, const Font& font) {
    return inkExtent(line, font).width();
}

int widestOf(const std::vector<std::string>& lines, const Font& font) {
    int widest = 0;
    for (const std::string& line : lines) widest = std::max(widest, widthOf(line, font));
    return widest;
}

/// Two lines, and the width of the space at which they were broken.
struct Break {
    std::vector<std::string> lines;
    std::size_t spaces = 0;
    int widest = 0;
};

std::vector<Break> breaksOf(const std::string& text, const Font& font) {
    std::vector<Break> breaks;
    for (std::size_t space = text.find(' '); space != std::string::npos;) {
        const std::size_t next = text.find_first_not_of(' ', space);
        Break found{{text.substr(0, space), text.substr(next)}, next - space, 0};
        found.widest = widestOf(found.lines, font);
        breaks.push_back(std::move(found));
        space = text.find(' ', next);
    }
    return breaks;
}

std::string cutLine(const std::string& line, int widthPixels, const Font& font) {
    if (widthOf(line, font) <= widthPixels) return line;
    std::size_t kept = 0, tooMany = line.size();
    while (tooMany - kept > 1) {
        const std::size_t middle = (kept + tooMany) / 2;
        const bool fits = widthOf(line.substr(0, middle) + std::string(cutMark), font) <= widthPixels;
        (fits ? kept : tooMany) = middle;
    }
    return line.substr(0, kept) + std::string(cutMark);
}

/// Shrinks the letters until the lines fit or the minimum size is reached.
FittedText shrunk(std::vector<std::string> lines, int widthPixels, Font font) {
    const int minimum = std::min(font.pixels, minimumFontPixels);
    int widest = widestOf(lines, font);
    while (widest > widthPixels && font.pixels > minimum) {
        font.pixels = std::clamp(font.pixels * widthPixels / widest, minimum, font.pixels - 1);
        widest = widestOf(lines, font);
    }
    for (std::string& line : lines) line = cutLine(line, widthPixels, font);
    return {std::move(lines), std::move(font)};
}

}  // namespace

int linePitch(const Font& font) {
    return lineExtent(font).height() + static_cast<int>(std::lround(0.12 * font.pixels));
}

int FittedText::width() const {
    return widestOf(lines, font);
}

int FittedText::height() const {
    if (lines.empty()) return 0;
    return lineExtent(font).height() + static_cast<int>(lines.size() - 1) * linePitch(font);
}

std::string drawableText(std::string_view text) {
    std::string drawable;
    while (!text.empty()) {
        const char letter = text.front();
        std::size_t bytes = 1;
        if (letter > ' ' && letter <= '~') {
            drawable += letter;
        } else if (static_cast<unsigned char>(letter) < 0x80) {
            drawable += ' ';
        } else {
            const auto [spelling, length] = spelled(text);
            drawable += spelling;
            bytes = length;
        }
        text.remove_prefix(bytes);
    }
    const std::size_t first = drawable.find_first_not_of(' ');
    if (first == std::string::npos) return "";
    return drawable.substr(first, drawable.find_last_not_of(' ') - first + 1);
}

FittedText fitText(std::string_view text, int widthPixels, const Font& font) {
    std::string line = drawableText(text);
    if (line.empty()) return {{}, font};
    if (line.size() > maximumLetters) line = drawableText(line.substr(0, maximumLetters)) + std::string(cutMark);
    if (widthOf(line, font) <= widthPixels) return {{line}, font};

    const std::vector<Break> breaks = breaksOf(line, font);
    const Break* best = nullptr;
    for (const Break& candidate : breaks) {
        if (candidate.widest > widthPixels) continue;
        if (!best || candidate.spaces > best->spaces ||
            (candidate.spaces == best->spaces && candidate.widest < best->widest))
            best = &candidate;
    }
    if (best) return {best->lines, font};
    if (breaks.empty()) return shrunk({line}, widthPixels, font);
    const auto narrowest = std::min_element(breaks.begin(), breaks.end(),
                                            [](const Break& a, const Break& b) { return a.widest < b.widest; });
    return shrunk(narrowest->lines, widthPixels, font);
}

std::vector<FittedText> fitAlike(const std::vector<std::string>& texts, int widthPixels, const Font& font) {
    std::vector<FittedText> fitted;
    Font common = font;
    for (const std::string& text : texts) {
        fitted.push_back(fitText(text, widthPixels, font));
        const int pixels = fitted.back().font.pixels;
        if (3 * pixels >= 2 * font.pixels) common.pixels = std::min(common.pixels, pixels);
    }
    if (common.pixels == font.pixels) return fitted;
    for (std::size_t i = 0; i < texts.size(); ++i) fitted[i] = fitText(texts[i], widthPixels, common);
    return fitted;
}

}  // namespace dustbench::bench
