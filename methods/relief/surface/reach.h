// The texels that a hit may change.
//
// Units: texels. Threads: pure.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

#include "methods/relief/surface/depth_map.h"
#include "methods/relief/surface/impact.h"
#include "methods/relief/surface/texel_rectangle.h"

namespace dustbench::relief {

/// std::lround, faster: the sum is exact.
[[nodiscard]] inline int nearestTo(float texel) {
    const auto exact = static_cast<double>(texel);
    return static_cast<int>(exact + std::copysign(0.5, exact));
}

/// The texels that a hit may change: within its radius, or the nearest one.
[[nodiscard]] inline TexelRectangle reachOf(const Impact& impact, const DepthMap& map) {
    if (impact.radiusTexels <= 0) {
        const int column = nearestTo(impact.u), row = nearestTo(impact.v);
        if (column < 0 || row < 0 || column >= map.columns() || row >= map.rows()) return {};
        return {column, row, column + 1, row + 1};
    }
    const double reach = std::max(0.5, static_cast<double>(impact.radiusTexels));
    const auto clamped = [](double texel, int size) {
        return static_cast<int>(std::clamp(texel, 0.0, static_cast<double>(size)));
    };
    const auto u = static_cast<double>(impact.u), v = static_cast<double>(impact.v);
    return {clamped(std::floor(u - reach), map.columns()), clamped(std::floor(v - reach), map.rows()),
            clamped(std::floor(u + reach) + 1, map.columns()), clamped(std::floor(v + reach) + 1, map.rows())};
}

/// The texel nearest to a hit; one past the last if the hit is outside the map.
[[nodiscard]] inline std::size_t nearestTexel(const Impact& impact, const DepthMap& map) {
    const int column = nearestTo(impact.u), row = nearestTo(impact.v);
    const bool isOutside = column < 0 || row < 0 || column >= map.columns() || row >= map.rows();
    return isOutside ? map.size() : map.texel(column, row);
}

/// The reaches of several hits, so that a gathering texel can compare many at once.
class Reaches {
 public:
    static constexpr std::size_t capacity = 1024, compared = 64;

    /// Of at most `capacity` hits.
    Reaches(std::span<const Impact> impacts, const DepthMap& map) {
        for (std::size_t k = 0; k < impacts.size(); ++k) {
            const TexelRectangle reach = reachOf(impacts[k], map);
            firstColumn_[k] = reach.firstColumn, firstRow_[k] = reach.firstRow;
            endColumn_[k] = reach.endColumn, endRow_[k] = reach.endRow;
        }
    }

    /// True if hit k may change this texel.
    [[nodiscard]] bool holds(std::size_t k, int column, int row) const {
        return (firstColumn_[k] <= column) & (column < endColumn_[k]) & (firstRow_[k] <= row) & (row < endRow_[k]);
    }
    /// True if one of the hits from `first` to `first + compared` may change this texel.
    [[nodiscard]] bool anyHolds(std::size_t first, int column, int row) const {
        int any = 0;
        for (std::size_t k = first; k < first + compared; ++k) any |= holds(k, column, row) ? 1 : 0;
        return any != 0;
    }

 private:
    std::array<int, capacity> firstColumn_{}, endColumn_{}, firstRow_{}, endRow_{};  // the rest reach nothing
};

}  // namespace dustbench::relief
