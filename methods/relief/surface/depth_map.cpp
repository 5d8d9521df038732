#include "methods/relief/surface/depth_map.h"

#include <algorithm>
#include <cmath>

namespace dustbench::relief {
namespace {

/// The corners of the patch that contains (u, v), and the position in it.
struct Patch {
    double lowerLeft, lowerRight, upperLeft, upperRight;
    double s, t;
};

Patch patchAt(const DepthMap& map, double u, double v) {
    const int i = static_cast<int>(std::floor(u)), j = static_cast<int>(std::floor(v));
    return {map.at(i, j),         map.at(i + 1, j),  map.at(i, j + 1),
            map.at(i + 1, j + 1), u - std::floor(u), v - std::floor(v)};
}

}  // namespace

DepthMap::DepthMap(const scene::Relief& relief, MemoryLedger& ledger)
    : columns_(relief.columns), rows_(relief.rows), depths_(ledger.account("relief depths")) {
    depths_.reserve(relief.depth.size());
    for (const float depth : relief.depth)
        depths_.push_back(static_cast<std::uint32_t>(std::llround(static_cast<double>(depth) * bottom)));
}

double DepthMap::at(int column, int row) const {
    const std::size_t place = texel(std::clamp(column, 0, columns_ - 1), std::clamp(row, 0, rows_ - 1));
    return static_cast<double>(depths_[place]) / bottom;
}

double DepthMap::depthAt(double u, double v) const {
    const Patch p = patchAt(*this, u, v);
    return (1 - p.t) * ((1 - p.s) * p.lowerLeft + p.s * p.lowerRight) +
           p.t * ((1 - p.s) * p.upperLeft + p.s * p.upperRight);
}

glm::dvec2 DepthMap::slopeAt(double u, double v) const {
    const Patch p = patchAt(*this, u, v);
    return {(1 - p.t) * (p.lowerRight - p.lowerLeft) + p.t * (p.upperRight - p.upperLeft),
            (1 - p.s) * (p.upperLeft - p.lowerLeft) + p.s * (p.upperRight - p.lowerRight)};
}

DepthPyramid::DepthPyramid(const DepthMap& map, MemoryLedger& ledger) : blocks_(ledger.account("relief pyramid")) {
    std::size_t offset = 0;
    for (int columns = map.columns() + 1, rows = map.rows() + 1;; columns = (columns + 1) / 2, rows = (rows + 1) / 2) {
        levels_.push_back({offset, columns, rows});
        offset += static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows);
        if (columns == 1 && rows == 1) break;
    }
    blocks_.resize(offset);
    update(map, {0, 0, map.columns(), map.rows()});
}

void DepthPyramid::update(const DepthMap& map, const TexelRectangle& changed) {
    if (changed.empty()) return;
    const Level& finest = levels_.front();
    const TexelRectangle blocks = blocksOver(changed, 0);
    for (int row = blocks.firstRow; row < blocks.endRow; ++row)
        for (int column = blocks.firstColumn; column < blocks.endColumn; ++column)
            blocks_[static_cast<std::size_t>(row) * static_cast<std::size_t>(finest.columns) +
                    static_cast<std::size_t>(column)] =
                static_cast<float>(std::min({map.at(column - 1, row - 1), map.at(column, row - 1),
                                             map.at(column - 1, row), map.at(column, row)}));
    for (std::size_t k = 1; k < levels_.size(); ++k) updateLevel(levels_[k - 1], levels_[k], blocksOver(changed, k));
}

TexelRectangle DepthPyramid::blocksOver(const TexelRectangle& texels, std::size_t level) {
    // Texel i belongs to the patches i and i + 1.
    return {texels.firstColumn >> level, texels.firstRow >> level, (texels.endColumn >> level) + 1,
            (texels.endRow >> level) + 1};
}

void DepthPyramid::updateLevel(const Level& finer, const Level& level, const TexelRectangle& blocks) {
    const auto at = [&](int column, int row) {
        const int i = std::min(column, finer.columns - 1), j = std::min(row, finer.rows - 1);
        return blocks_[finer.offset + static_cast<std::size_t>(j) * static_cast<std::size_t>(finer.columns) +
                       static_cast<std::size_t>(i)];
    };
    for (int row = blocks.firstRow; row < blocks.endRow; ++row)
        for (int column = blocks.firstColumn; column < blocks.endColumn; ++column)
            blocks_[level.offset + static_cast<std::size_t>(row) * static_cast<std::size_t>(level.columns) +
                    static_cast<std::size_t>(column)] =
                std::min({at(2 * column, 2 * row), at(2 * column + 1, 2 * row), at(2 * column, 2 * row + 1),
                          at(2 * column + 1, 2 * row + 1)});
}

}  // namespace dustbench::relief
