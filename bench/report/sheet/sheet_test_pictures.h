// For tests: pictures to fill contact sheets with.
#pragma once

#include <optional>
#include <string>
#include <utility>

#include "bench/measure/image/test_images.h"
#include "bench/report/sheet/contact_sheet.h"

namespace dustbench::bench {

inline pictures::Image plainPicture(int width, int height, glm::vec3 colour) {
    return imageOf(width, height, [colour](int, int, int c) { return static_cast<double>(colour[c]); });
}

/// Waves whose phase tells the pictures apart.
inline pictures::Image wavyPicture(int width, int height, int number) {
    return imageOf(width, height, [number](int x, int y, int c) {
        return 0.45 + 0.4 * std::sin(0.11 * x + 0.07 * y + 1.3 * number + 0.6 * c);
    });
}

/// 3 columns, 2 rows; one cell is left empty; every kind of text, and a scale.
inline ContactSheet fullSheet(int width = 96, int height = 72) {
    ContactSheet sheet;
    sheet.title = "Slalom, 15 m/s";
    sheet.columns = {"reference", "billboard", "FLIP of billboard"};
    sheet.rows = {"frame 48, 0.80 s", "frame 96, 1.60 s"};
    sheet.scale = SheetScale{0, 0.5f, "FLIP"};
    for (int row = 0; row < 2; ++row) {
        auto& cells = sheet.cells.emplace_back();
        for (int column = 0; column < 3; ++column)
            cells.push_back(SheetCell{wavyPicture(width, height, 3 * row + column),
                                      column == 0 ? "" : "PSNR 38.2 dB  SSIM 0.994  FLIP 0.015"});
    }
    sheet.cells[1][2].reset();
    return sheet;
}

inline SheetStyle smallStyle() {
    SheetStyle style;
    style.tileWidthPixels = 120;
    style.fontPixels = 12;
    style.marginPixels = 10;
    style.gapPixels = 6;
    return style;
}

}  // namespace dustbench::bench
