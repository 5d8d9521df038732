#include "methods/kit/light/sun_depth.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <numeric>
#include <stdexcept>

#include "methods/contract/volume.h"
#include "methods/kit/maths/fast_functions.h"
#include "methods/kit/maths/transmittance.h"

namespace dustbench::light {
namespace {

constexpr double maximumCells = 256;  ///< along each side of the grid
constexpr std::size_t atOnce = 16;
constexpr double minimumExponent = -1000;  ///< of 2: below any depth that counts

std::vector<std::uint32_t> allOf(const Puffs& store) {
    std::vector<std::uint32_t> indices(store.size());
    std::iota(indices.begin(), indices.end(), 0u);
    return indices;
}

}  // namespace

glm::dmat3 sunFrame(const glm::dvec3& toSun) {
    const double length = glm::length(toSun);
    if (!(length > 0) || !std::isfinite(length)) throw std::invalid_argument("sunFrame: `toSun` has no direction");
    const glm::dvec3 along = toSun / length;
    const glm::dvec3 aside = std::abs(along.y) < 0.9 ? glm::dvec3(0, 1, 0) : glm::dvec3(1, 0, 0);
    const glm::dvec3 first = glm::normalize(glm::cross(aside, along));
    return {first, glm::cross(along, first), along};
}

SunDepth::SunDepth(const Puffs& store, const glm::dvec3& toSun, double opticalDepthShare, double neglected)
    : SunDepth(store, toSun, opticalDepthShare, neglected, allOf(store)) {}

SunDepth::SunDepth(const Puffs& store, const glm::dvec3& toSun, double opticalDepthShare, double neglected,
                   std::span<const std::uint32_t> indices)
    : frame_(sunFrame(toSun)) {
    std::vector<double> reaches;
    glm::dvec2 high(-std::numeric_limits<double>::infinity());
    low_ = -high;
    for (const std::uint32_t i : indices) {
        const double s = maths::puffDeviationMetres(static_cast<double>(store.radius[i]));
        const double tau = opticalDepthShare * maths::puffOpticalDepth(static_cast<double>(store.opacity[i]));
        const glm::dvec3 centre = glm::dvec3(store.position(i)) * frame_;
        if (!(s > 0) || !(tau > neglected) || !std::isfinite(s + centre.x + centre.y + centre.z)) continue;
        const Entry puff{centre.x,
                         centre.y,
                         centre.z,
                         std::log2(tau),
                         std::numbers::log2e / (2 * s * s),
                         1 / (std::numbers::sqrt2 * s)};
        puffs_.push_back(puff);
        reaches.push_back(s * std::sqrt(2 * std::log(tau / neglected)));
        low_ = glm::min(low_, glm::dvec2(puff.u, puff.v) - reaches.back());
        high = glm::max(high, glm::dvec2(puff.u, puff.v) + reaches.back());
    }
    if (puffs_.empty()) return;

    // Cells of a quarter metre, or larger for a wide cloud.
    const double edge = std::max(high.x - low_.x, high.y - low_.y);
    cellMetres_ = std::max(0.25, edge / maximumCells);
    cells_ = glm::ivec2(glm::ceil((high - low_) / cellMetres_)) + 1;
    // Two passes over the puffs: first each cell's count, then its entries, in the order of the store.
    const auto forEachCell = [&](auto visit) {
        for (std::size_t i = 0; i < puffs_.size(); ++i)
            for (int y = cell(puffs_[i].v - reaches[i], 1); y <= cell(puffs_[i].v + reaches[i], 1); ++y)
                for (int x = cell(puffs_[i].u - reaches[i], 0); x <= cell(puffs_[i].u + reaches[i], 0); ++x)
                    visit(static_cast<std::size_t>(y * cells_.x + x), static_cast<std::uint32_t>(i));
    };
    cellStart_.assign(static_cast<std::size_t>(cells_.x) * static_cast<std::size_t>(cells_.y) + 1, 0);
    forEachCell([&](std::size_t k, std::uint32_t) { ++cellStart_[k + 1]; });
    for (std::size_t k = 1; k < cellStart_.size(); ++k) cellStart_[k] += cellStart_[k - 1];
    cellPuffs_.resize(cellStart_.back());
    std::vector<std::uint32_t> next(cellStart_.begin(), cellStart_.end() - 1);
    forEachCell([&](std::size_t k, std::uint32_t i) { cellPuffs_[next[k]++] = i; });
}

int SunDepth::cell(double coordinate, int axis) const {
    const double index = std::floor((coordinate - low_[axis]) / cellMetres_);
    return static_cast<int>(std::clamp(index, 0.0, static_cast<double>(cells_[axis] - 1)));
}

double SunDepth::at(const glm::dvec3& position) const {
    if (puffs_.empty()) return 0;
    const glm::dvec3 place = position * frame_;
    const double u = place.x, v = place.y, w = place.z;
    // No puff extends beyond the edge; edge cells contribute only negligible depth.
    const std::size_t k = static_cast<std::size_t>(cell(v, 1)) * static_cast<std::size_t>(cells_.x) +
                          static_cast<std::size_t>(cell(u, 0));
    const maths::HalfErrorFunction& halfErf = maths::HalfErrorFunction::instance();
    const std::uint32_t end = cellStart_[k + 1];
    double sum = 0;
    // Processed in batches, so that the loop vectorises; the last batch is padded with puffs of zero depth.
    std::array<double, atOnce> exponents, along, depths;
    for (std::uint32_t n = cellStart_[k]; n < end; n += atOnce) {
        exponents.fill(minimumExponent);
        along.fill(0);
        const std::size_t count = std::min<std::size_t>(atOnce, end - n);
        for (std::size_t i = 0; i < count; ++i) {
            const Entry& puff = puffs_[cellPuffs_[n + i]];
            const double du = u - puff.u, dv = v - puff.v;
            exponents[i] = std::max(minimumExponent, puff.logDepth - (du * du + dv * dv) * puff.scale);
            along[i] = (puff.w - w) * puff.inverseWidth;
        }
        for (std::size_t i = 0; i < atOnce; ++i)
            depths[i] = maths::powerOfTwo(exponents[i]) * (0.5 + halfErf(along[i]));
        for (const double depth : depths) sum += depth;
    }
    return sum;
}

}  // namespace dustbench::light
