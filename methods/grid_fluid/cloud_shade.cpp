#include "methods/grid_fluid/cloud_shade.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace dustbench::grid_fluid {

void CloudShade::set(const Id& id, const raycast::ShownGrid& grid) {
    blockMetres_ = grid.spacingMetres * block;
    Blocks& blocks = grids_[id];
    blocks.share = 1;
    blocks.count = (grid.cells + block - 1) / block;
    blocks.minimum = grid.originMetres;
    const auto index = [](const glm::ivec3& at, const glm::ivec3& size) {
        return static_cast<std::size_t>(at.x + size.x * (at.y + size.y * at.z));
    };
    blocks.mean.assign(index({0, 0, blocks.count.z}, blocks.count), 0.0f);
    std::size_t cell = 0;
    for (int k = 0; k < grid.cells.z; ++k)
        for (int j = 0; j < grid.cells.y; ++j)
            for (int i = 0; i < grid.cells.x; ++i, ++cell)
                blocks.mean[index(glm::ivec3(i, j, k) / block, blocks.count)] += grid.density[cell];
    for (float& mean : blocks.mean) mean /= block * block * block;
}

void CloudShade::change(const Id& id, const glm::dvec3& originMetres, double share) {
    Blocks& blocks = grids_.at(id);
    blocks.minimum = originMetres;
    blocks.share = share;
}

float CloudShade::arrivingAt(const glm::dvec3& place, const Id& without) const {
    double depth = 0;
    for (const auto& [id, grid] : grids_) {
        if (id == without) continue;
        const glm::dvec3 maximum = grid.minimum + blockMetres_ * glm::dvec3(grid.count);
        double from = 0, to = std::numeric_limits<double>::infinity();
        for (int axis = 0; axis < 3; ++axis) {
            const double a = (grid.minimum[axis] - place[axis]) / toSun_[axis];
            const double b = (maximum[axis] - place[axis]) / toSun_[axis];
            from = std::max(from, std::min(a, b));
            to = std::min(to, std::max(a, b));
        }
        for (double at = from; at < to; at += blockMetres_) {
            const double step = std::min(blockMetres_, to - at);
            const glm::dvec3 inBlocks = (place + (at + 0.5 * step) * toSun_ - grid.minimum) / blockMetres_;
            const glm::ivec3 in = glm::clamp(glm::ivec3(inBlocks), glm::ivec3(0), grid.count - 1);
            depth += step * grid.share *
                     static_cast<double>(
                         grid.mean[static_cast<std::size_t>(in.x + grid.count.x * (in.y + grid.count.y * in.z))]);
        }
    }
    return static_cast<float>(std::exp(-depth * extinction_));
}

}  // namespace dustbench::grid_fluid
