#include "bench/report/sheet/contact_sheet.h"

#include <algorithm>
#include <utility>

#include "bench/measure/image/heat_map.h"
#include "bench/measure/image/image_check.h"
#include "bench/report/sheet/sheet_layout.h"

namespace dustbench::bench {
namespace {

constexpr float paper = 1, ink = 0.15f;  // display-encoded greys
constexpr float line = 0.6f;             // around the bar

/// Clamped, and opaque to the bit.
pictures::Image asShown(pictures::Image image) {
    for (glm::vec4& pixel : image.pixels) pixel = glm::vec4(glm::clamp(glm::vec3(pixel), 0.0f, 1.0f), 1);
    return image;
}

class SheetImage {
 public:
    SheetImage(int width, int height) : image_{width, height, {}} {
        const std::size_t pixels = static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
        image_.pixels.assign(pixels, glm::vec4(1));
    }

    [[nodiscard]] glm::vec4& at(int x, int y) {
        return image_
            .pixels[static_cast<std::size_t>(y) * static_cast<std::size_t>(image_.width) + static_cast<std::size_t>(x)];
    }

    void drawPicture(const pictures::Image& picture, const SheetBox& box) {
        // Before resampling, so that values far above white do not spread; after, to clamp rounding errors.
        const pictures::Image shown = asShown(resampled(asShown(picture), box.width, box.height));
        for (int y = 0; y < box.height; ++y) std::copy_n(&shown.at(0, y), box.width, &at(box.x, box.y + y));
    }

    void drawText(const PlacedText& placed) {
        const Font& font = placed.text.font;
        const int ascent = -lineExtent(font).top;
        int baseline = placed.box.y + ascent;
        for (const std::string& words : placed.text.lines) {
            const InkExtent extent = inkExtent(words, font);
            const int rest = placed.box.width - extent.width();
            const int indent = placed.align == TextAlign::centre ? rest / 2 : 0;
            drawInk(inkCoverage(words, font), placed.box.x + indent, baseline + extent.top);
            baseline += linePitch(font);
        }
    }

    void drawBar(const SheetBox& box, int lineWidth) {
        const float outline = maths::decodeSrgb(line);
        for (int y = -lineWidth; y < box.height + lineWidth; ++y)
            for (int x = -lineWidth; x < box.width + lineWidth; ++x) {
                const bool inside = x >= 0 && x < box.width && y >= 0 && y < box.height;
                const float share = (static_cast<float>(x) + 0.5f) / static_cast<float>(box.width);
                at(box.x + x, box.y + y) = glm::vec4(inside ? heatColour(share) : glm::vec3(outline), 1);
            }
    }

    [[nodiscard]] pictures::Image take() { return std::move(image_); }

 private:
    /// Blended in display-encoded values; in linear light dark letters on white look thin.
    void drawInk(const Plane& coverage, int left, int top) {
        for (int y = 0; y < coverage.height; ++y)
            for (int x = 0; x < coverage.width; ++x) {
                const float share = coverage.at(x, y);
                if (share > 0)
                    at(left + x, top + y) = glm::vec4(glm::vec3(maths::decodeSrgb(paper + share * (ink - paper))), 1);
            }
    }

    pictures::Image image_;
};

}  // namespace

pictures::Image drawSheet(const ContactSheet& sheet, const SheetStyle& style) {
    const SheetLayout layout = layOut(sheet, style);
    for (const PlacedPicture& placed : layout.pictures) {
        const pictures::Image& picture = sheet.cells[placed.row][placed.column]->picture;
        const std::string name = cellName(sheet, placed.row, placed.column);
        requireFinite(picture, name);
        requireOpaque(picture, name);
    }
    SheetImage image(layout.width, layout.height);
    for (const PlacedPicture& placed : layout.pictures)
        image.drawPicture(sheet.cells[placed.row][placed.column]->picture, placed.box);
    for (const PlacedText& placed : layout.texts) image.drawText(placed);
    if (layout.bar) image.drawBar(*layout.bar, std::max(1, style.fontPixels / 20));
    return image.take();
}

}  // namespace dustbench::bench
