#include "bench/report/text_lines.h"

#include <array>
#include <cstddef>

namespace dustbench::bench {
namespace {

/// Advances of ' ' to '~' in DejaVu Sans, in thousandths of the nominal font height.
constexpr std::array<int, 95> advances{
    318,  401, 460, 838, 636, 950, 780, 275, 390, 390, 500, 838, 318, 361, 318, 337,  //  !"#$%&'()*+,-./
    636,  636, 636, 636, 636, 636, 636, 636, 636, 636, 337, 337, 838, 838, 838, 531,  // 0123456789:;<=>?
    1000, 684, 686, 698, 770, 632, 575, 775, 752, 295, 295, 656, 557, 863, 748, 787,  // @ABCDEFGHIJKLMNO
    603,  787, 695, 635, 611, 732, 684, 989, 685, 611, 685, 390, 337, 390, 838, 500,  // PQRSTUVWXYZ[\]^_
    500,  613, 635, 550, 635, 615, 352, 635, 634, 278, 278, 579, 278, 974, 634, 612,  // `abcdefghijklmno
    635,  635, 411, 521, 392, 634, 592, 818, 592, 592, 525, 636, 337, 636, 838};      // pqrstuvwxyz{|}~
constexpr double otherAdvance = 1;                                                    // of letters that are not ASCII
constexpr double boldFactor = 1.24;  // maximum over the letters of DejaVu Sans Bold

std::size_t lengthOfFirst(std::string_view text) {
    std::size_t bytes = 1;
    while (bytes < text.size() && (static_cast<unsigned char>(text[bytes]) & 0xC0u) == 0x80u) ++bytes;
    return bytes;
}

/// The parts between runs of at least `spaces` spaces.
std::vector<std::string_view> split(std::string_view text, std::size_t spaces) {
    std::vector<std::string_view> parts;
    const std::string separator(spaces, ' ');
    while (!text.empty()) {
        const std::size_t end = text.find(separator);
        if (end != 0) parts.push_back(text.substr(0, end));
        if (end == std::string_view::npos) break;
        text.remove_prefix(end + spaces);
        text.remove_prefix(std::min(text.find_first_not_of(' '), text.size()));
    }
    return parts;
}

/// As many letters as fit, but at least one; of an identifier or a path, whole parts if the first fits.
std::string_view fittingPart(std::string_view word, double widthPixels, const Lettering& lettering) {
    std::size_t bytes = lengthOfFirst(word);
    while (bytes < word.size()) {
        const std::size_t next = bytes + lengthOfFirst(word.substr(bytes));
        if (textWidth(word.substr(0, next), lettering) > widthPixels) break;
        bytes = next;
    }
    const std::size_t joint = bytes < word.size() ? word.substr(0, bytes).find_last_of("_/") : std::string_view::npos;
    return word.substr(0, joint == std::string_view::npos || joint == 0 ? bytes : joint + 1);
}

class Breaker {
 public:
    Breaker(double widthPixels, const Lettering& lettering) : width_(widthPixels), lettering_(lettering) {}

    /// Appends the part to the last line if it fits, otherwise begins a new line with it.
    void add(std::string_view part, std::size_t spaces) {
        if (!lines_.empty()) {
            const std::string longer = lines_.back() + std::string(spaces, ' ') + std::string(part);
            if (fits(longer)) {
                lines_.back() = longer;
                return;
            }
        }
        if (fits(part)) {
            lines_.emplace_back(part);
        } else if (const auto words = split(part, 1); words.size() > 1) {
            lines_.emplace_back();
            for (const std::string_view word : words) add(word, lines_.back().empty() ? 0 : 1);
        } else {
            if (!lines_.empty() && lines_.back().empty()) lines_.pop_back();
            for (std::string_view rest = part; !rest.empty(); rest.remove_prefix(lines_.back().size()))
                lines_.emplace_back(fittingPart(rest, width_, lettering_));
        }
    }

    [[nodiscard]] std::vector<std::string> take() { return std::move(lines_); }

 private:
    [[nodiscard]] bool fits(std::string_view text) const { return textWidth(text, lettering_) <= width_; }

    double width_;
    const Lettering& lettering_;
    std::vector<std::string> lines_;
};

}  // namespace

double textWidth(std::string_view text, const Lettering& lettering) {
    double ems = 0;
    while (!text.empty()) {
        const char first = text.front();
        ems += first >= ' ' && first <= '~' ? advances[static_cast<std::size_t>(first - ' ')] / 1000.0 : otherAdvance;
        text.remove_prefix(lengthOfFirst(text));
    }
    return ems * lettering.pixels * (lettering.bold ? boldFactor : 1);
}

std::vector<std::string> brokenText(std::string_view text, double widthPixels, const Lettering& lettering) {
    Breaker breaker(widthPixels, lettering);
    for (const std::string_view part : split(text, 2)) breaker.add(part, 2);
    return breaker.take();
}

}  // namespace dustbench::bench
