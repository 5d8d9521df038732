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

}  // namespace dustbench::relief
