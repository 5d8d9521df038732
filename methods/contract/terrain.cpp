#include "methods/contract/terrain.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace dustbench::scene {
namespace {

/// Position of a coordinate on one axis of the grid: the cell, the fraction within it, and whether it lies inside the
/// grid.
struct Place {
    int cell;
    float share;
    bool inside;
};

Place locate(float coordinate, float origin, float spacing, int samples) {
    const float last = static_cast<float>(samples - 1);
    const float grid = (coordinate - origin) / spacing;
    const float held = std::clamp(grid, 0.0f, last);
    const int cell = std::min(static_cast<int>(held), samples - 2);
    return {cell, held - static_cast<float>(cell), grid >= 0 && grid <= last};
}

}  // namespace

Terrain::Terrain(std::vector<float> heights, int columns, int rows, float spacingMetres, float originX, float originZ)
    : heights_(std::move(heights)), columns_(columns), rows_(rows), spacing_(spacingMetres), origin_(originX, originZ) {
    if (columns < 2 || rows < 2 ||
        heights_.size() != static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows))
        throw std::invalid_argument("Terrain: columns and rows must be 2 or more, with columns x rows heights");
    if (!(spacingMetres > 0)) throw std::invalid_argument("Terrain: the spacing must be positive");
}

float Terrain::heightAt(float x, float z) const {
    if (isFlat()) return 0;
    const Place u = locate(x, origin_.x, spacing_, columns_);
    const Place v = locate(z, origin_.y, spacing_, rows_);
    const float* row = &heights_[static_cast<std::size_t>(v.cell) * static_cast<std::size_t>(columns_) +
                                 static_cast<std::size_t>(u.cell)];
    const float* next = row + columns_;
    const float near = row[0] + u.share * (row[1] - row[0]);
    const float far = next[0] + u.share * (next[1] - next[0]);
    return near + v.share * (far - near);
}

glm::vec3 Terrain::normalAt(float x, float z) const {
    if (isFlat()) return {0, 1, 0};
    const Place u = locate(x, origin_.x, spacing_, columns_);
    const Place v = locate(z, origin_.y, spacing_, rows_);
    const float* row = &heights_[static_cast<std::size_t>(v.cell) * static_cast<std::size_t>(columns_) +
                                 static_cast<std::size_t>(u.cell)];
    const float* next = row + columns_;
    // n ∝ (−∂h/∂x, 1, −∂h/∂z)
    const float slopeX = u.inside ? ((row[1] - row[0]) * (1 - v.share) + (next[1] - next[0]) * v.share) / spacing_ : 0;
    const float slopeZ = v.inside ? ((next[0] - row[0]) * (1 - u.share) + (next[1] - row[1]) * u.share) / spacing_ : 0;
    return glm::normalize(glm::vec3(-slopeX, 1, -slopeZ));
}

}  // namespace dustbench::scene
