// A uniform grid over points, for neighbours within a distance, in linear time.
//
// Cells are cubes with an edge of at least `reach`, so that all neighbours of a point are in its cell and the 26 around
// it. Points are copied in the order of their cells; cells next to each other along x are contiguous, so that the 27
// cells are 9 runs of points. Within a cell, points keep the order in which they were given.
//
// Units: m. Owns: the copies. Threads: `build` by one, with the current oneTBB arena; const members by any.
// Source: Green2010, 3 (counting sort into cells).
#pragma once

#include <array>
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
    /// Cell of each point, in the order of the cells.
    [[nodiscard]] std::uint32_t cellOf(std::size_t place) const { return cellOfPlace_[place]; }
    /// The cell and the 26 around it.
    [[nodiscard]] std::array<Run, 9> around(std::uint32_t cell) const;
    [[nodiscard]] std::size_t bytes() const;

 private:
    void chooseCells(std::span<const float> x, std::span<const float> y, std::span<const float> z, float reachMetres);

    glm::vec3 minimum_{0};
    float perEdge_ = 1;  ///< 1/edge
    glm::ivec3 cells_{1};
    std::vector<std::uint32_t> cellOfPoint_, cellOfPlace_, order_;
    std::vector<std::uint32_t> begin_;  ///< of each cell in `order_`, and the end
};

}  // namespace dustbench::particles
