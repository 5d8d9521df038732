#include "methods/kit/particles/point_grid.h"

#include "methods/kit/parallel/for_each_block.h"

namespace dustbench::particles {
namespace {

constexpr std::size_t gridBlock = 8192;

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
    double edge = static_cast<double>(reachMetres) / 2;
    const glm::dvec3 extent(high - low);
    const auto cellsAt = [&] { return glm::floor(extent / edge) + 1.0; };
    for (glm::dvec3 cells = cellsAt(); cells.x * cells.y * cells.z > most && edge < 1e30; cells = cellsAt())
        edge *= 1.25;
    perEdge_ = static_cast<float>(1 / edge);
    const glm::dvec3 cells = cellsAt();
    cells_ = cells.x * cells.y * cells.z <= most ? glm::ivec3(cells) : glm::ivec3(1);
    slack_ = 0.01f + 5e-7f * static_cast<float>(std::max({cells_.x, cells_.y, cells_.z}));
    reach_ = reachMetres + static_cast<float>(static_cast<double>(slack_) * edge);
}

void PointGrid::build(std::span<const float> x, std::span<const float> y, std::span<const float> z, float reachMetres) {
    const std::size_t count = x.size();
    for (auto* column : {&cellOfPoint_, &order_}) column->resize(count);
    chooseCells(x, y, z, reachMetres);
    parallel::forEachBlock(count, gridBlock, [&](std::size_t first, std::size_t number) {
        for (std::size_t i = first; i < first + number; ++i) {
            const int column = cellAlong(x[i], 0);
            const int row = cellAlong(y[i], 1);
            const int layer = cellAlong(z[i], 2);
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
        order_[begin_[cellOfPoint_[i]]++] = static_cast<std::uint32_t>(i);
    }
    std::copy_backward(begin_.begin(), begin_.end() - 1, begin_.end());
    begin_[0] = 0;
}

std::size_t PointGrid::bytes() const {
    return (cellOfPoint_.capacity() + order_.capacity() + begin_.capacity()) * sizeof(std::uint32_t);
}

}  // namespace dustbench::particles
