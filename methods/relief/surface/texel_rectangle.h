// A rectangle of texels of a relief. Threads: pure.
#pragma once

#include <algorithm>

namespace dustbench::relief {

/// Texels [firstColumn, endColumn) × [firstRow, endRow).
struct TexelRectangle {
    int firstColumn = 0, firstRow = 0, endColumn = 0, endRow = 0;

    [[nodiscard]] int columns() const { return endColumn - firstColumn; }
    [[nodiscard]] int rows() const { return endRow - firstRow; }
    [[nodiscard]] bool empty() const { return firstColumn >= endColumn || firstRow >= endRow; }
};

/// The smallest that contains both.
[[nodiscard]] inline TexelRectangle joined(const TexelRectangle& a, const TexelRectangle& b) {
    if (a.empty()) return b;
    if (b.empty()) return a;
    return {std::min(a.firstColumn, b.firstColumn), std::min(a.firstRow, b.firstRow),
            std::max(a.endColumn, b.endColumn), std::max(a.endRow, b.endRow)};
}

}  // namespace dustbench::relief
