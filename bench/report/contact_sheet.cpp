#include "bench/report/contact_sheet.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <sstream>
#include <stdexcept>

#include "bench/measure/image/heat_map.h"
#include "bench/measure/image/picture.h"
#include "bench/measure/image/resampled.h"
#include "bench/report/page.h"
#include "bench/report/picture_sets.h"
#include "methods/contract/errors.h"
#include "methods/kit/files/printable.h"

namespace dustbench::report {
namespace {

constexpr int tileWidth = 400, gap = 12, margin = 20;
constexpr int rowHeadingWidth = 160;  // maximum, unless a word is wider
constexpr int rowWordWidth = 300;     // maximum, for wider words
constexpr int barHeight = 22;
constexpr Lettering plainText{28, false}, boldText{28, true}, titleText{33, true};

int linePitch(const Lettering& lettering) {
    return static_cast<int>(std::lround(1.2 * lettering.pixels));
}

/// `contact sheet, row 2 ("frame 48"), column 3 ("billboard")`: for messages.
std::string cellName(const ContactSheet& sheet, std::size_t row, std::size_t column) {
    const auto quoted = [](const std::vector<std::string>& headings, std::size_t index) {
        return index < headings.size() ? " (\"" + headings[index] + "\")" : std::string();
    };
    return fmt::format("contact sheet, row {}{}, column {}{}", row + 1, quoted(sheet.rows, row), column + 1,
                       quoted(sheet.columns, column));
}

void requireThat(bool holds, const std::string& message) {
    if (!holds) throw std::invalid_argument("contact sheet: " + message);
}

/// Checks everything except the pictures. Returns the number of columns.
std::size_t checkedColumns(const ContactSheet& sheet) {
    requireThat(!sheet.cells.empty() && !sheet.cells.front().empty(), "there are no cells");
    const std::size_t columns = sheet.cells.front().size(), rows = sheet.cells.size();
    for (const auto& row : sheet.cells)
        requireThat(row.size() == columns,
                    fmt::format("rows of {} and {} cells, expected the same number in each", columns, row.size()));
    requireThat(sheet.columns.empty() || sheet.columns.size() == columns,
                fmt::format("got {} headings for {} columns", sheet.columns.size(), columns));
    requireThat(sheet.rows.empty() || sheet.rows.size() == rows,
                fmt::format("got {} headings for {} rows", sheet.rows.size(), rows));
    if (sheet.scale)
        requireThat(std::isfinite(sheet.scale->minimum) && std::isfinite(sheet.scale->maximum) &&
                        sheet.scale->minimum < sheet.scale->maximum,
                    "the scale's maximum must be above its minimum");
    return columns;
}

/// Height of the pictures at the tiles' width. All heights agree to within half a pixel.
int checkedTileHeight(const ContactSheet& sheet) {
    std::optional<double> height;
    std::string first;
    for (std::size_t row = 0; row < sheet.cells.size(); ++row)
        for (std::size_t column = 0; column < sheet.cells[row].size(); ++column) {
            const auto& cell = sheet.cells[row][column];
            if (!cell) continue;
            const pictures::Image& picture = cell->picture;
            if (picture.width < 1 || picture.height < 1)
                throw InputError(cellName(sheet, row, column) + ": the picture has no pixels");
            const double own = static_cast<double>(tileWidth) * picture.height / picture.width;
            const std::string size = fmt::format("{}x{}", picture.width, picture.height);
            if (!height) {
                height = own;
                first = size;
            }
            if (std::abs(own - *height) > 0.5)
                throw InputError(fmt::format("{}: got a picture of {}, expected the shape of the first one, {}",
                                             cellName(sheet, row, column), size, first));
        }
    requireThat(height.has_value(), "there are no pictures");
    return static_cast<int>(std::lround(std::clamp(*height, 1.0, 1e8)));
}

/// Clamped, with an alpha of exactly 1.
pictures::Image asShown(pictures::Image image) {
    for (glm::vec4& pixel : image.pixels) pixel = glm::vec4(glm::clamp(glm::vec3(pixel), 0.0f, 1.0f), 1);
    return image;
}

pictures::Image scaleBar(int width, int height) {
    pictures::Image bar{width, height, {}};
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x)
            bar.pixels.emplace_back(measure::heatColour((static_cast<float>(x) + 0.5f) / static_cast<float>(width)), 1);
    return bar;
}

using Lines = std::vector<std::string>;

Lines linesOf(const std::string& text, int width, const Lettering& lettering) {
    return brokenText(files::printable(text), width, lettering);
}

int heightOf(const Lines& lines, const Lettering& lettering) {
    return static_cast<int>(lines.size()) * linePitch(lettering);
}

double widestWord(const std::string& text, const Lettering& lettering) {
    std::istringstream words(files::printable(text));
    double widest = 0;
    for (std::string word; words >> word;) widest = std::max(widest, textWidth(word, lettering));
    return widest;
}

/// Writes the sheet from top to bottom.
class SheetWriter {
 public:
    explicit SheetWriter(const ContactSheet& sheet)
        : sheet_(sheet), columns_(checkedColumns(sheet)), tileHeight_(checkedTileHeight(sheet)) {
        double longestWord = 0, widest = 0;
        for (const std::string& row : sheet.rows) longestWord = std::max(longestWord, widestWord(row, plainText));
        const int allowed = std::clamp(static_cast<int>(std::ceil(longestWord)), rowHeadingWidth, rowWordWidth);
        for (const std::string& row : sheet.rows) {
            rowHeadings_.push_back(linesOf(row, allowed, plainText));
            for (const std::string& line : rowHeadings_.back()) widest = std::max(widest, textWidth(line, plainText));
        }
        gridX_ = margin + (widest > 0 ? static_cast<int>(std::ceil(widest)) + gap : 0);
        requireRoom();
    }

    std::string run() {
        writeTitle();
        writeColumnHeadings();
        for (std::size_t row = 0; row < sheet_.cells.size(); ++row) writeRow(row);
        y_ -= gap;
        if (sheet_.scale) writeScale(*sheet_.scale);
        const int width = right() + margin, height = y_ + margin;
        return fmt::format(
            "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0}\" height=\"{1}\" viewBox=\"0 0 {0} {1}\" "
            "font-family=\"DejaVu Sans, sans-serif\" fill=\"#262626\">\n"
            "<rect width=\"100%\" height=\"100%\" fill=\"white\"/>\n{2}</svg>\n",
            width, height, body_);
    }

 private:
    [[nodiscard]] int columnX(std::size_t column) const {
        return gridX_ + static_cast<int>(column) * (tileWidth + gap);
    }
    [[nodiscard]] int right() const { return columnX(columns_ - 1) + tileWidth; }

    /// Checks the size of the tiles before anything is encoded.
    void requireRoom() const {
        const double width = static_cast<double>(columns_) * (tileWidth + gap) + gridX_ + margin;
        const double height =
            static_cast<double>(sheet_.cells.size()) * (tileHeight_ + gap + 3 * linePitch(plainText)) + 2.0 * margin +
            4 * linePitch(titleText);
        if (std::max(width, height) > maximumSheetSide)
            throw InputError(
                fmt::format("contact sheet: got {} rows of {} pictures, {:.0f}x{:.0f} pixels in all, allowed: {} a "
                            "side; choose fewer frames",
                            sheet_.cells.size(), columns_, width, height, maximumSheetSide));
    }

    void writeImage(const pictures::Image& image, int x, int y) {
        fmt::format_to(std::back_inserter(body_),
                       "<image x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\" preserveAspectRatio=\"none\" "
                       "href=\"{}\"/>\n",
                       x, y, image.width, image.height, dataUrl("image/png", pictures::encodedPng(image)));
    }

    /// `anchor` is start, middle or end: the part of each line that is at `x`. `y` is the top of the first line.
    void writeText(const Lines& lines, int x, int y, const char* anchor, const Lettering& lettering) {
        for (const std::string& line : lines) {
            fmt::format_to(std::back_inserter(body_),
                           "<text x=\"{}\" y=\"{:.0f}\" text-anchor=\"{}\" font-size=\"{}\"{} "
                           "xml:space=\"preserve\">{}</text>\n",
                           x, y + 0.95 * lettering.pixels, anchor, lettering.pixels,
                           lettering.bold ? " font-weight=\"bold\"" : "", escaped(line));
            y += linePitch(lettering);
        }
    }

    void writeTitle() {
        const Lines title = linesOf(sheet_.title, right() - margin, titleText);
        writeText(title, margin, y_, "start", titleText);
        y_ += title.empty() ? 0 : heightOf(title, titleText) + gap;
    }

    void writeColumnHeadings() {
        std::vector<Lines> headings;
        int tallest = 0;
        for (const std::string& column : sheet_.columns) {
            headings.push_back(linesOf(column, tileWidth, boldText));
            tallest = std::max(tallest, heightOf(headings.back(), boldText));
        }
        for (std::size_t column = 0; column < headings.size(); ++column)
            writeText(headings[column], columnX(column) + tileWidth / 2,
                      y_ + tallest - heightOf(headings[column], boldText), "middle", boldText);
        y_ += tallest > 0 ? tallest + gap / 2 : 0;
    }

    void writeRow(std::size_t row) {
        int tallest = tileHeight_;
        if (!rowHeadings_.empty()) {
            // A heading may be taller than a wide picture; it never starts above the row.
            const int height = heightOf(rowHeadings_[row], plainText);
            writeText(rowHeadings_[row], margin, y_ + std::max(0, (tileHeight_ - height) / 2), "start", plainText);
            tallest = std::max(tallest, height);
        }
        for (std::size_t column = 0; column < columns_; ++column) {
            const auto& cell = sheet_.cells[row][column];
            if (!cell) continue;
            const std::string name = cellName(sheet_, row, column);
            measure::requireFinite(cell->picture, name);
            measure::requireOpaque(cell->picture, name);
            // Clamped before resampling, so that values far above white do not spread, and again for rounding errors.
            writeImage(asShown(measure::resampled(asShown(cell->picture), tileWidth, tileHeight_)), columnX(column),
                       y_);
            const Lines caption = linesOf(cell->caption, tileWidth, plainText);
            const int captionY = y_ + tileHeight_ + gap / 3;
            writeText(caption, columnX(column) + tileWidth / 2, captionY, "middle", plainText);
            if (!caption.empty()) tallest = std::max(tallest, captionY + heightOf(caption, plainText) - y_);
        }
        y_ += tallest + gap;
    }

    /// Writes the bar, and below it `minimum label maximum`.
    void writeScale(const SheetScale& scale) {
        y_ += 2 * gap;
        const int middle = (gridX_ + right()) / 2, left = middle - tileWidth / 2;
        writeImage(scaleBar(tileWidth, barHeight), left, y_);
        y_ += barHeight + gap / 3;
        const Lines minimum{fmt::format("{:.4g}", scale.minimum)}, maximum{fmt::format("{:.4g}", scale.maximum)};
        const Lines label = linesOf(scale.label, tileWidth / 2, plainText);
        writeText(minimum, left, y_, "start", plainText);
        writeText(label, middle, y_, "middle", plainText);
        writeText(maximum, left + tileWidth, y_, "end", plainText);
        y_ += std::max(linePitch(plainText), heightOf(label, plainText));
    }

    const ContactSheet& sheet_;
    std::size_t columns_;
    int tileHeight_;
    std::vector<Lines> rowHeadings_;
    int gridX_ = margin;
    int y_ = margin;
    std::string body_;
};

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

std::string contactSheetSvg(const ContactSheet& sheet) {
    return SheetWriter(sheet).run();
}

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

}  // namespace dustbench::report
