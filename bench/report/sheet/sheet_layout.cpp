#include "bench/report/sheet/sheet_layout.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "methods/contract/errors.h"

namespace dustbench::bench {
namespace {

void requireThat(bool holds, const std::string& message) {
    if (!holds) throw std::invalid_argument("contact sheet: " + message);
}

void requireInRange(const char* name, int value, int minimum, int maximum) {
    requireThat(value >= minimum && value <= maximum,
                fmt::format("{}: got {}, allowed: {} to {}", name, value, minimum, maximum));
}

/// What does not depend on the pictures. Returns the number of columns.
std::size_t checkedColumns(const ContactSheet& sheet, const SheetStyle& style) {
    requireInRange("tileWidthPixels", style.tileWidthPixels, 64, 8192);
    requireInRange("fontPixels", style.fontPixels, 6, style.tileWidthPixels / 4);
    requireInRange("marginPixels", style.marginPixels, 0, 8192);
    requireInRange("gapPixels", style.gapPixels, 0, 8192);
    requireThat(!sheet.cells.empty() && !sheet.cells.front().empty(), "there are no cells");
    const std::size_t columns = sheet.cells.front().size(), rows = sheet.cells.size();
    for (const auto& row : sheet.cells)
        requireThat(row.size() == columns,
                    fmt::format("rows of {} and {} cells, expected as many in each", columns, row.size()));
    requireThat(sheet.columns.empty() || sheet.columns.size() == columns,
                fmt::format("got {} headings for {} columns", sheet.columns.size(), columns));
    requireThat(sheet.rows.empty() || sheet.rows.size() == rows,
                fmt::format("got {} headings for {} rows", sheet.rows.size(), rows));
    if (sheet.scale)
        requireThat(std::isfinite(sheet.scale->minimum) && std::isfinite(sheet.scale->maximum) &&
                        sheet.scale->minimum < sheet.scale->maximum,
                    "the scale's `most` must be above its `least`");
    return columns;
}

/// Height of a picture at the tiles' width. All agree within half a pixel.
double checkedTileHeight(const ContactSheet& sheet, int tileWidth) {
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
    return *height;
}

/// Fills the sheet from the top.
class Layouter {
 public:
    Layouter(const ContactSheet& sheet, const SheetStyle& style)
        : sheet_(sheet),
          style_(style),
          columns_(checkedColumns(sheet, style)),
          tileHeight_(
              static_cast<int>(std::lround(std::clamp(checkedTileHeight(sheet, style.tileWidthPixels), 1.0, 1e9)))) {}

    SheetLayout run() {
        y_ = style_.marginPixels;
        placeRowHeadingsWidth();
        requireRoom();
        placeTitle();
        placeColumnHeadings();
        placeRows();
        if (sheet_.scale) placeScale(*sheet_.scale);
        layout_.width = right() + style_.marginPixels;
        layout_.height = y_ + style_.marginPixels;
        return std::move(layout_);
    }

 private:
    [[nodiscard]] int share(double ofFont) const { return static_cast<int>(std::lround(ofFont * style_.fontPixels)); }
    [[nodiscard]] Font font() const { return {style_.font, style_.fontPixels}; }
    [[nodiscard]] Font boldFont(double ofFont) const { return {style_.boldFont, share(ofFont)}; }
    [[nodiscard]] int columnX(std::size_t column) const {
        return gridX_ + static_cast<int>(column) * (style_.tileWidthPixels + style_.gapPixels);
    }
    [[nodiscard]] int right() const { return columnX(columns_ - 1) + style_.tileWidthPixels; }

    void place(FittedText text, SheetBox box, TextAlign align) {
        if (!text.lines.empty()) layout_.texts.push_back({box, std::move(text), align});
    }

    void placeRowHeadingsWidth() {
        rowHeadings_ = fitAlike(sheet_.rows, 2 * style_.tileWidthPixels / 5, font());
        for (const FittedText& heading : rowHeadings_) rowHeadingWidth_ = std::max(rowHeadingWidth_, heading.width());
        gridX_ = style_.marginPixels + rowHeadingWidth_ + (rowHeadingWidth_ > 0 ? share(0.6) : 0);
    }

    /// Of tiles and gaps alone, before anything is allocated.
    void requireRoom() const {
        const double width =
            2.0 * style_.marginPixels + static_cast<double>(columns_) * (style_.tileWidthPixels + style_.gapPixels);
        const double height =
            2.0 * style_.marginPixels +
            static_cast<double>(sheet_.cells.size()) * (tileHeight_ + 4.0 * style_.fontPixels + style_.gapPixels);
        if (width * height > static_cast<double>(maximumSheetPixels))
            throw InputError(
                fmt::format("contact sheet: got {} rows of {} pictures, {:.0f} million pixels in all, "
                            "allowed: {} million; take fewer frames or narrower tiles",
                            sheet_.cells.size(), columns_, width * height / 1e6, maximumSheetPixels / 1000000));
    }

    void placeTitle() {
        const int x = style_.marginPixels, width = right() - x;
        FittedText title = fitText(sheet_.title, width, boldFont(7.0 / 6));
        if (title.lines.empty()) return;
        const int height = title.height();
        place(std::move(title), {x, y_, width, height}, TextAlign::left);
        y_ += height + share(0.6);
    }

    void placeColumnHeadings() {
        std::vector<FittedText> headings = fitAlike(sheet_.columns, style_.tileWidthPixels, boldFont(1));
        const int tallest = tallestOf(headings);
        if (tallest == 0) return;
        for (std::size_t column = 0; column < headings.size(); ++column) {
            const int height = headings[column].height();
            place(std::move(headings[column]), {columnX(column), y_ + tallest - height, style_.tileWidthPixels, height},
                  TextAlign::centre);
        }
        y_ += tallest + share(0.2);
    }

    void placeRows() {
        std::vector<std::string> captions;
        for (const auto& row : sheet_.cells)
            for (const auto& cell : row) captions.push_back(cell ? cell->caption : "");
        std::vector<FittedText> fitted = fitAlike(captions, style_.tileWidthPixels, font());
        for (std::size_t row = 0; row < sheet_.cells.size(); ++row) {
            if (row > 0) y_ += style_.gapPixels;
            placeRow(row, {fitted.begin() + static_cast<std::ptrdiff_t>(row * columns_),
                           fitted.begin() + static_cast<std::ptrdiff_t>((row + 1) * columns_)});
        }
    }

    void placeRow(std::size_t row, std::vector<FittedText> captions) {
        const int tile = style_.tileWidthPixels;
        for (std::size_t column = 0; column < columns_; ++column)
            if (sheet_.cells[row][column])
                layout_.pictures.push_back({{columnX(column), y_, tile, tileHeight_}, row, column});
        if (!rowHeadings_.empty()) {
            const int height = rowHeadings_[row].height();
            // Beside a flat picture the heading may be the taller one; it never starts above the row.
            place(rowHeadings_[row],
                  {style_.marginPixels, y_ + std::max(0, (tileHeight_ - height) / 2), rowHeadingWidth_, height},
                  TextAlign::left);
        }
        const int tallest = tallestOf(captions), captionY = y_ + tileHeight_ + share(0.2);
        for (std::size_t column = 0; column < columns_; ++column) {
            const int height = captions[column].height();
            place(std::move(captions[column]), {columnX(column), captionY, tile, height}, TextAlign::centre);
        }
        int bottom = tallest > 0 ? captionY + tallest + share(0.3) : y_ + tileHeight_;
        if (!rowHeadings_.empty()) bottom = std::max(bottom, y_ + rowHeadings_[row].height());
        y_ = bottom;
    }

    /// `label  minimum ▭ maximum` about the middle of the columns. Of the room, a third is the label's at most, a fifth
    /// each number's, a tenth all spaces': a sixth is left for the bar.
    void placeScale(const SheetScale& scale) {
        const int room = right() - gridX_, space = std::min(share(0.4), room / 40);
        std::vector<FittedText> parts{fitText(scale.label, room / 3, font()),
                                      fitText(fmt::format("{:.4g}", scale.minimum), room / 5, font()),
                                      fitText(fmt::format("{:.4g}", scale.maximum), room / 5, font())};
        int textWidth = 2 * space;
        for (const FittedText& part : parts) textWidth += part.width();
        if (!parts[0].lines.empty()) textWidth += 2 * space;
        const int barWidth = std::min(style_.tileWidthPixels, room - textWidth);
        const int height = std::max(tallestOf(parts), share(1)), barHeight = share(0.8);

        y_ += share(0.6);
        int x = gridX_ + (room - textWidth - barWidth) / 2;
        const auto next = [&](FittedText& part, int gapAfter) {
            const int width = part.width(), own = part.height();
            if (width == 0) return;
            place(std::move(part), {x, y_ + (height - own) / 2, width, own}, TextAlign::left);
            x += width + gapAfter;
        };
        next(parts[0], 2 * space);
        next(parts[1], space);
        layout_.bar = {x, y_ + (height - barHeight) / 2, barWidth, barHeight};
        x += barWidth + space;
        next(parts[2], 0);
        y_ += height;
    }

    static int tallestOf(const std::vector<FittedText>& texts) {
        int tallest = 0;
        for (const FittedText& text : texts) tallest = std::max(tallest, text.height());
        return tallest;
    }

    const ContactSheet& sheet_;
    const SheetStyle& style_;
    std::size_t columns_;
    int tileHeight_;
    std::vector<FittedText> rowHeadings_;
    int rowHeadingWidth_ = 0;
    int gridX_ = 0;
    int y_ = 0;
    SheetLayout layout_;
};

}  // namespace

std::string cellName(const ContactSheet& sheet, std::size_t row, std::size_t column) {
    const auto quoted = [](const std::vector<std::string>& headings, std::size_t index) {
        return index < headings.size() ? " (\"" + headings[index] + "\")" : std::string();
    };
    return fmt::format("contact sheet, row {}{}, column {}{}", row + 1, quoted(sheet.rows, row), column + 1,
                       quoted(sheet.columns, column));
}

SheetLayout layOut(const ContactSheet& sheet, const SheetStyle& style) {
    return Layouter(sheet, style).run();
}

}  // namespace dustbench::bench
