#include "methods/relief/surface/sliding.h"

#include <algorithm>
#include <cmath>
#include <deque>
#include <vector>

namespace dustbench::relief {
namespace {

constexpr double slack = 1e-3;  // relative to tan φ: moves end this far below it, which reduces their number

struct Place {
    int column, row;
};

/// The lower of a texel's two neighbours along one axis, and how many steps lower it is; 0: neither is lower.
struct Lower {
    Place place;
    std::int64_t drop = 0;
};

class Sliding {
 public:
    Sliding(DepthMap& map, std::span<std::uint32_t> laid, const Repose& repose)
        : map_(map),
          laid_(laid),
          perStep_(repose.slopePerStep()),
          tangent_(repose.tangent),
          waits_(map.size(), false) {}

    void enqueue(const Place& place) {
        if (place.column < 0 || place.row < 0 || place.column >= map_.columns() || place.row >= map_.rows()) return;
        const std::size_t texel = map_.texel(place.column, place.row);
        if (laid_[texel] == 0 || waits_[texel]) return;
        waits_[texel] = true;
        queue_.push_back(place);
    }

    TexelRectangle run(TexelRectangle changed) {
        while (!queue_.empty()) {
            const Place place = queue_.front();
            queue_.pop_front();
            waits_[map_.texel(place.column, place.row)] = false;
            changed = joined(changed, settle(place));
        }
        return changed;
    }

    [[nodiscard]] Lower lowerAlong(const Place& place, int axis) const {
        Lower lowest{place, 0};
        for (const int side : {-1, 1}) {
            const Place next{place.column + (axis == 0 ? side : 0), place.row + (axis == 1 ? side : 0)};
            if (next.column < 0 || next.row < 0 || next.column >= map_.columns() || next.row >= map_.rows()) continue;
            const std::int64_t drop = std::int64_t{depthAt(next)} - std::int64_t{depthAt(place)};
            if (drop > lowest.drop) lowest = {next, drop};
        }
        return lowest;
    }

 private:
    [[nodiscard]] std::uint32_t depthAt(const Place& place) const {
        return map_.depths()[map_.texel(place.column, place.row)];
    }

    /// Moves excess material of a texel to its lower neighbours. Returns the texels that changed.
    TexelRectangle settle(const Place& place) {
        const Lower u = lowerAlong(place, 0), v = lowerAlong(place, 1);
        const double gu = perStep_.x * static_cast<double>(u.drop), gv = perStep_.y * static_cast<double>(v.drop);
        const double g = std::hypot(gu, gv);
        if (g <= tangent_) return {};
        // d|g|/dm of a move m that lowers this texel by m and raises the others by their shares of it.
        const double shareU = gu / (gu + gv), shareV = gv / (gu + gv);
        const double perMove = (gu * perStep_.x * (1 + shareU) + gv * perStep_.y * (1 + shareV)) / g;
        const double move = (g - tangent_ * (1 - slack)) / perMove;
        const std::int64_t toU = give(place, u, move * shareU), toV = give(place, v, move * shareV);
        if (toU + toV == 0) return {};
        for (const Place& moved : {place, u.place, v.place})
            for (const auto& [du, dv] : {std::pair(0, 0), {-1, 0}, {1, 0}, {0, -1}, {0, 1}})
                enqueue({moved.column + du, moved.row + dv});
        return {std::min({place.column, u.place.column, v.place.column}),
                std::min({place.row, u.place.row, v.place.row}),
                std::max({place.column, u.place.column, v.place.column}) + 1,
                std::max({place.row, u.place.row, v.place.row}) + 1};
    }

    std::int64_t give(const Place& from, const Lower& to, double steps) {
        const std::size_t texel = map_.texel(from.column, from.row);
        const std::int64_t most = std::min<std::int64_t>(laid_[texel], to.drop / 2);
        const auto given = std::min(static_cast<std::int64_t>(std::ceil(steps)), most);
        if (given <= 0) return 0;
        const auto amount = static_cast<std::uint32_t>(given);
        const std::size_t below = map_.texel(to.place.column, to.place.row);
        map_.depths()[texel] += amount;
        laid_[texel] -= amount;
        map_.depths()[below] -= amount;
        laid_[below] += amount;
        return given;
    }

    DepthMap& map_;
    std::span<std::uint32_t> laid_;
    glm::dvec2 perStep_;
    double tangent_;
    std::vector<bool> waits_;
    std::deque<Place> queue_;
};

}  // namespace

glm::dvec2 slopeDown(const DepthMap& map, int column, int row, const Repose& repose) {
    const auto drop = [&](int du, int dv) {
        const double here = map.at(column, row);
        return std::max({map.at(column - du, row - dv) - here, map.at(column + du, row + dv) - here, 0.0});
    };
    return repose.slopePerStep() * (1.0 * DepthMap::bottom) * glm::dvec2(drop(1, 0), drop(0, 1));
}

TexelRectangle slide(DepthMap& map, std::span<std::uint32_t> laid, const TexelRectangle& moved, const Repose& repose) {
    if (moved.empty()) return moved;
    Sliding sliding(map, laid, repose);
    for (int row = moved.firstRow - 1; row <= moved.endRow; ++row)
        for (int column = moved.firstColumn - 1; column <= moved.endColumn; ++column) sliding.enqueue({column, row});
    return sliding.run(moved);
}

}  // namespace dustbench::relief
