// A uniform grid over points, for neighbours within a distance, in linear time.
//
// Points are ordered by cells, cubes with an edge of half the reach or more. Cells next to each other along x are
// contiguous, so that the neighbours of a point are in one run of points for each row of cells that a ball of this
// radius meets: at most 25. Within a cell, points keep the order in which they were given.
//
// Units: m. Owns: the copies. Threads: `build` by one, with the current oneTBB arena; const members by any.
// Source: Green2010, 3 (counting sort into cells).
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

namespace dustbench::particles {

class PointGrid {
 public:
    /// Points `first` to `end` in the order of the cells.
    struct Run {
        std::uint32_t first, end;
    };

    /// Replaces the points. If they are spread so far that cells would outnumber them by far, cells are larger.
    void build(std::span<const float> x, std::span<const float> y, std::span<const float> z, float reachMetres);

    [[nodiscard]] std::size_t size() const { return order_.size(); }
    /// Index of each point as given, in the order of the cells.
    [[nodiscard]] std::span<const std::uint32_t> order() const { return order_; }
    /// Calls `action(run)` for runs that hold all points within the reach of `point`, and others, each point once.
    template <typename Action>
    void forEachRun(const glm::vec3& point, const Action& action) const;
    [[nodiscard]] std::size_t bytes() const;

 private:
    void chooseCells(std::span<const float> x, std::span<const float> y, std::span<const float> z, float reachMetres);
    /// Number of the cell along an axis; points that are not finite are in the first.
    [[nodiscard]] int cellAlong(float coordinate, int axis) const {
        const float at = (coordinate - minimum_[axis]) * perEdge_;
        return at > 0 ? static_cast<int>(std::min(at, static_cast<float>(cells_[axis] - 1))) : 0;
    }
    /// Distance of a coordinate from a cell along an axis, less the slack.
    [[nodiscard]] float away(float coordinate, int cell, int axis) const {
        const float at = (coordinate - minimum_[axis]) * perEdge_;
        const float cells = std::max(static_cast<float>(cell) - at, at - static_cast<float>(cell + 1));
        return cells > slack_ ? (cells - slack_) / perEdge_ : 0;
    }

    glm::vec3 minimum_{0};
    float perEdge_ = 1;  ///< 1/edge
    float reach_ = 0;
    float slack_ = 0;  ///< in cells: bound on the rounding error of a coordinate in cells
    glm::ivec3 cells_{1};
    std::vector<std::uint32_t> cellOfPoint_, order_;
    std::vector<std::uint32_t> begin_;  ///< of each cell in `order_`, and the end
};

template <typename Action>
void PointGrid::forEachRun(const glm::vec3& point, const Action& action) const {
    const float reach2 = reach_ * reach_;
    const int endLayer = cellAlong(point.z + reach_, 2) + 1, endRow = cellAlong(point.y + reach_, 1) + 1;
    for (int layer = cellAlong(point.z - reach_, 2); layer < endLayer; ++layer) {
        const float upwards = away(point.z, layer, 2);
        for (int row = cellAlong(point.y - reach_, 1); row < endRow; ++row) {
            const float sideways = away(point.y, row, 1);
            const float left2 = reach2 - upwards * upwards - sideways * sideways;
            if (left2 < 0) continue;
            const float half = std::sqrt(left2);
            const int line = cells_.x * (row + cells_.y * layer);
            const Run run{begin_[static_cast<std::size_t>(line + cellAlong(point.x - half, 0))],
                          begin_[static_cast<std::size_t>(line + cellAlong(point.x + half, 0)) + 1]};
            if (run.first < run.end) action(run);
        }
    }
}

}  // namespace dustbench::particles
