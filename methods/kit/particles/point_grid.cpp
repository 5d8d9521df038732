#include "methods/kit/particles/point_grid.h"

#include <algorithm>
#include <cmath>

#include "methods/kit/parallel/for_each_block.h"

namespace dustbench::particles {
namespace {

constexpr std::size_t gridBlock = 8192;

/// Number of the cell along an axis; points that are not finite are in the first.
int cellAlong(float coordinate, float minimum, float perEdge, int cells) {
    const float at = (coordinate - minimum) * perEdge;
    return at > 0 ? static_cast<int>(std::min(at, static_cast<float>(cells - 1))) : 0;
}

}  // namespace

void PointGrid::chooseCells(std::span<const float> x, std::span<const float> y, std::span<const float> z,
                            float reachMetres) {
    glm::vec3 low(INFINITY), high(-INFINITY);
    for (std::size_t i = 0; i < x.size(); ++i) {
        const glm::vec3 p(x[i], y[i], z[i]);
        low = glm::min(low, p);
        high = glm::max(high, p);
    }
    minimum_ = low;
    const double most = 4 * static_cast<double>(x.size()) + 64;
    double edge = static_cast<double>(reachMetres);
    const glm::dvec3 extent(high - low);
    const auto cellsAt = [&] { return glm::floor(extent / edge) + 1.0; };
    for (glm::dvec3 cells = cellsAt(); cells.x * cells.y * cells.z > most && edge < 1e30; cells = cellsAt())
        edge *= 1.25;
    perEdge_ = static_cast<float>(1 / edge);
    const glm::dvec3 cells = cellsAt();
    cells_ = cells.x * cells.y * cells.z <= most ? glm::ivec3(cells) : glm::ivec3(1);
}

void PointGrid::build(std::span<const float> x, std::span<const float> y, std::span<const float> z, float reachMetres) {
    const std::size_t count = x.size();
    for (auto* column : {&cellOfPoint_, &cellOfPlace_, &order_}) column->resize(count);
    // A cell is a little larger than the reach: rounding must not put a neighbour two cells away.
    chooseCells(x, y, z, 1.0001f * reachMetres);
    parallel::forEachBlock(count, gridBlock, [&](std::size_t first, std::size_t number) {
        for (std::size_t i = first; i < first + number; ++i) {
            const int column = cellAlong(x[i], minimum_.x, perEdge_, cells_.x);
            const int row = cellAlong(y[i], minimum_.y, perEdge_, cells_.y);
            const int layer = cellAlong(z[i], minimum_.z, perEdge_, cells_.z);
            cellOfPoint_[i] = static_cast<std::uint32_t>(column + cells_.x * (row + cells_.y * layer));
        }
    });
    begin_.assign(
        static_cast<std::size_t>(cells_.x) * static_cast<std::size_t>(cells_.y) * static_cast<std::size_t>(cells_.z) +
            1,
        0);
    for (const std::uint32_t cell : cellOfPoint_) ++begin_[cell + 1];
    for (std::size_t c = 1; c < begin_.size(); ++c) begin_[c] += begin_[c - 1];
    // Each point takes the next place of its cell, which moves the beginnings; they are moved back afterwards.
    for (std::size_t i = 0; i < count; ++i) {
        const std::uint32_t place = begin_[cellOfPoint_[i]]++;
        order_[place] = static_cast<std::uint32_t>(i);
        cellOfPlace_[place] = cellOfPoint_[i];
    }
    std::copy_backward(begin_.begin(), begin_.end() - 1, begin_.end());
    begin_[0] = 0;
}

std::array<PointGrid::Run, 9> PointGrid::around(std::uint32_t cell) const {
    const auto number = static_cast<int>(cell);
    const glm::ivec3 at(number % cells_.x, number / cells_.x % cells_.y, number / (cells_.x * cells_.y));
    const int firstColumn = std::max(at.x - 1, 0), endColumn = std::min(at.x + 2, cells_.x);
    std::array<Run, 9> runs{};
    std::size_t next = 0;
    for (int layer = at.z - 1; layer <= at.z + 1; ++layer)
        for (int row = at.y - 1; row <= at.y + 1; ++row, ++next) {
            if (layer < 0 || layer >= cells_.z || row < 0 || row >= cells_.y) continue;
            const int line = cells_.x * (row + cells_.y * layer);
            runs[next] = {begin_[static_cast<std::size_t>(line + firstColumn)],
                          begin_[static_cast<std::size_t>(line + endColumn)]};
        }
    return runs;
}

std::size_t PointGrid::bytes() const {
    return (cellOfPoint_.capacity() + cellOfPlace_.capacity() + order_.capacity() + begin_.capacity()) *
           sizeof(std::uint32_t);
}

}  // namespace dustbench::particles
