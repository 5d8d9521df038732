#include "methods/grid_fluid/trail/dust_trail.h"

#include <algorithm>
#include <cmath>
#include <span>

#include "methods/kit/maths/hash.h"

namespace dustbench::grid_fluid {
namespace {

constexpr float quiet = 1;  ///< seconds without new dust, after which a tile may be dropped

}  // namespace
std::array<int, 3> DustTrail::tileOf(const glm::ivec3& cell) {
    const auto along = [](int at) { return at >= 0 ? at / edge : -((edge - 1 - at) / edge); };
    return {along(cell.x), along(cell.y), along(cell.z)};
}

std::size_t DustTrail::indexOf(const glm::ivec3& cell, const std::array<int, 3>& tile) {
    const glm::ivec3 at = cell - edge * glm::ivec3(tile[0], tile[1], tile[2]);
    return static_cast<std::size_t>(at.x + edge * (at.y + edge * at.z));
}

void DustTrail::pass(float seconds) {
    driftMetres_ += glm::dvec3(settings_.windMetresPerSecond) * static_cast<double>(seconds);
    const auto kept = static_cast<double>(std::exp(-settings_.decayPerSecond * seconds));
    for (auto& [place, tile] : tiles_) {
        tile.share *= kept;
        tile.amountM3 *= kept;
        tile.quietSeconds += seconds;
    }
}

void DustTrail::add(const Cuboid& where, double amountM3) {
    const glm::dvec3 from = inCells(where.minimum), to = inCells(where.maximum);
    const Overlaps x(from.x, to.x), y(from.y, to.y), z(from.z, to.z);
    for (int k = 0; k < z.count; ++k)
        for (int j = 0; j < y.count; ++j)
            for (int i = 0; i < x.count; ++i) {
                const auto share = [](const Overlaps& along, int n) {
                    return along.shares[static_cast<std::size_t>(n)];
                };
                addTo({x.first + i, y.first + j, z.first + k}, amountM3 * share(x, i) * share(y, j) * share(z, k));
            }
}

void DustTrail::addTo(const glm::ivec3& cell, double amountM3) {
    const std::array place = tileOf(cell);
    Tile& tile = tiles_.try_emplace(place, account_).first->second;
    const double cellM3 = std::pow(settings_.spacingMetres, 3);
    // If little of the old dust is left, new dust divided by `share` would exceed the range of floats.
    if (tile.share < 1e-6) {
        for (float& density : tile.density) density *= static_cast<float>(tile.share);
        tile.share = 1;
    }
    tile.density[indexOf(cell, place)] += static_cast<float>(amountM3 / cellM3 / tile.share);
    tile.changed = true;
    tile.quietSeconds = 0;
}

void DustTrail::takeEntered(const Cuboid& box,
                            const std::function<void(const glm::dvec3& middle, double amountM3)>& taker) {
    // Centres in [minimum, maximum) of the box; the tolerance is for lattices that coincide.
    const auto firstMiddle = [&](const glm::dvec3& place) {
        return glm::ivec3(glm::ceil(inCells(place) - 0.5 - 1e-6));
    };
    const CellRange now{firstMiddle(box.minimum), firstMiddle(box.maximum)};
    const double cellM3 = std::pow(settings_.spacingMetres, 3);
    for (auto& [place, tile] : tiles_) {
        const glm::ivec3 first = edge * glm::ivec3(place[0], place[1], place[2]);
        const glm::ivec3 from = glm::max(first, now.first), end = glm::min(first + edge, now.end);
        for (glm::ivec3 cell = from; cell.z < end.z; ++cell.z)
            for (cell.y = from.y; cell.y < end.y; ++cell.y)
                for (cell.x = from.x; cell.x < end.x; ++cell.x) {
                    if (inBox_.contains(cell)) continue;
                    float& density = tile.density[indexOf(cell, place)];
                    if (density == 0) continue;
                    taker(driftMetres_ + (glm::dvec3(cell) + 0.5) * settings_.spacingMetres,
                          static_cast<double>(density) * tile.share * cellM3);
                    density = 0;
                    tile.changed = true;
                }
    }
    inBox_ = now;
}

void DustTrail::settle(double leastM3, double leastDensity) {
    const double cellM3 = std::pow(settings_.spacingMetres, 3);
    for (auto& [place, tile] : tiles_) {
        if (!tile.changed) continue;
        double sum = 0;
        tile.maximum = 0;
        for (const float density : tile.density) {
            sum += static_cast<double>(density);
            tile.maximum = std::max(tile.maximum, density);
        }
        tile.amountM3 = sum * tile.share * cellM3;
        ++tile.version;
        tile.changed = false;
    }
    std::erase_if(tiles_, [&](const auto& entry) {
        const Tile& tile = entry.second;
        return tile.quietSeconds > quiet && tile.amountM3 < leastM3 &&
               static_cast<double>(tile.maximum) * tile.share < leastDensity;
    });
}

double DustTrail::amountM3() const {
    double sum = 0;
    for (const auto& [place, tile] : tiles_) sum += tile.amountM3;
    return sum;
}

std::uint64_t DustTrail::stateHash() const {
    maths::Hash hash;
    for (const auto& [place, tile] : tiles_) {
        hash.add(std::span<const int>(place)).add(tile.share);
        hash.add(std::span<const float>(tile.density));
    }
    for (int axis = 0; axis < 3; ++axis) hash.add(driftMetres_[axis]);
    return hash.value();
}

}  // namespace dustbench::grid_fluid
