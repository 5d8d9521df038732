#include "methods/relief/surface/worn_surface.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <numeric>
#include <span>
#include <utility>

#include "methods/kit/lanes/lanes.h"

namespace dustbench::relief {
namespace {

using lanes::Double4;
using lanes::Float4;
using lanes::Int4;
using lanes::Unsigned4;

constexpr std::size_t spareTexels = 3;  // four are written at a time, starting at any texel
constexpr int tileTexels = 64;
constexpr std::size_t fewHits = 1000;
constexpr std::size_t nearTexels = std::size_t{1} << 17;  // two columns of them take 1 MiB

/// changeWithin of four columns at once. `squaredDv`: (row − v)².
[[gnu::always_inline]] inline Int4 changesWithin(const Impact& impact, const Int4& columns, float squaredDv) {
    const Float4 du = __builtin_convertvector(columns, Float4) - impact.u;
    const Float4 share = 1 - (du * du + squaredDv) / (impact.radiusTexels * impact.radiusTexels);
    const Double4 inside = __builtin_convertvector(lanes::atLeast(share, Float4{}), Double4);
    return __builtin_convertvector(inside * static_cast<double>(impact.depth), Int4);
}

// --- The texels that a hit may change

/// std::lround, faster: the sum is exact.
int nearestTo(float texel) {
    const auto exact = static_cast<double>(texel);
    return static_cast<int>(exact + std::copysign(0.5, exact));
}

/// The texels that a hit may change: within its radius, or the nearest one.
TexelRectangle reachOf(const Impact& impact, const DepthMap& map) {
    if (impact.radiusTexels <= 0) {
        const int column = nearestTo(impact.u), row = nearestTo(impact.v);
        if (column < 0 || row < 0 || column >= map.columns() || row >= map.rows()) return {};
        return {column, row, column + 1, row + 1};
    }
    const double reach = std::max(0.5, static_cast<double>(impact.radiusTexels));
    const auto clamped = [](double texel, int size) {
        return static_cast<int>(std::clamp(texel, 0.0, static_cast<double>(size)));
    };
    const auto u = static_cast<double>(impact.u), v = static_cast<double>(impact.v);
    return {clamped(std::floor(u - reach), map.columns()), clamped(std::floor(v - reach), map.rows()),
            clamped(std::floor(u + reach) + 1, map.columns()), clamped(std::floor(v + reach) + 1, map.rows())};
}

/// The texel nearest to a hit; one past the last if the hit is outside the map.
std::size_t nearestTexel(const Impact& impact, const DepthMap& map) {
    const int column = nearestTo(impact.u), row = nearestTo(impact.v);
    const bool isOutside = column < 0 || row < 0 || column >= map.columns() || row >= map.rows();
    return isOutside ? map.size() : map.texel(column, row);
}

/// The reaches of several hits, so that a gathering texel can compare many at once.
class Reaches {
 public:
    static constexpr std::size_t capacity = 1024, compared = 64;

    /// Of at most `capacity` hits.
    Reaches(std::span<const Impact> impacts, const DepthMap& map) {
        for (std::size_t k = 0; k < impacts.size(); ++k) {
            const TexelRectangle reach = reachOf(impacts[k], map);
            firstColumn_[k] = reach.firstColumn, firstRow_[k] = reach.firstRow;
            endColumn_[k] = reach.endColumn, endRow_[k] = reach.endRow;
        }
    }

    /// True if hit k may change this texel.
    [[nodiscard]] bool holds(std::size_t k, int column, int row) const {
        return (firstColumn_[k] <= column) & (column < endColumn_[k]) & (firstRow_[k] <= row) & (row < endRow_[k]);
    }
    /// True if one of the hits from `first` to `first + compared` may change this texel.
    [[nodiscard]] bool anyHolds(std::size_t first, int column, int row) const {
        int any = 0;
        for (std::size_t k = first; k < first + compared; ++k) any |= holds(k, column, row) ? 1 : 0;
        return any != 0;
    }

 private:
    std::array<int, capacity> firstColumn_{}, endColumn_{}, firstRow_{}, endRow_{};  // the rest reach nothing
};

}  // namespace

WornSurface::WornSurface(const scene::Relief& relief, MemoryLedger& ledger)
    : depths_(relief, ledger),
      hits_(ledger.account("relief hits")),
      worn_(ledger.account("relief wear")),
      laid_(ledger.account("relief deposit")),
      pending_(ledger.account("relief pending")),
      sorted_(ledger.account("relief sorted hits")),
      tileEnds_(ledger.account("relief sorted hits")) {
    for (LedgerVector<std::uint32_t>* column : {&hits_, &worn_, &laid_}) column->resize(depths_.size());
    pending_.resize(depths_.size() + spareTexels);
    initial_ = presentVolume();
    changed_ = {0, 0, depths_.columns(), depths_.rows()};
}

std::uint64_t WornSurface::presentVolume() const {
    std::uint64_t volume = 0;
    for (const std::uint32_t depth : depths_.depths()) volume += DepthMap::bottom - depth;
    return volume;
}

TexelRectangle WornSurface::takeChanged() {
    return std::exchange(changed_, {});
}

void WornSurface::addPending(std::size_t texel, std::uint32_t change) {
    pending_[texel] = std::min(DepthMap::bottom, pending_[texel] + change);
}

void WornSurface::gather(std::span<const Impact> impacts) {
    for (std::size_t first = 0; first < impacts.size(); first += Reaches::capacity) {
        const auto held = impacts.subspan(first, std::min(Reaches::capacity, impacts.size() - first));
        const Reaches reaches(held, depths_);
        for (int row = 0; row < depths_.rows(); ++row)
            for (int column = 0; column < depths_.columns(); ++column)
                for (std::size_t k = 0; k < held.size(); k += Reaches::compared)
                    if (reaches.anyHolds(k, column, row))
                        gatherAt(column, row, held.subspan(k, std::min(Reaches::compared, held.size() - k)));
    }
    if (!impacts.empty()) waiting_ = {0, 0, depths_.columns(), depths_.rows()};
}

void WornSurface::gatherAt(int column, int row, std::span<const Impact> impacts) {
    const std::size_t texel = depths_.texel(column, row);
    for (const Impact& impact : impacts) {
        addPending(texel, changeAt(impact, column, row));
        hits_[texel] += nearestTexel(impact, depths_) == texel ? 1 : 0;
    }
}

void WornSurface::addPit(const Impact& impact, const TexelRectangle& reach) {
    for (int row = reach.firstRow; row < reach.endRow; ++row) {
        const float dv = static_cast<float>(row) - impact.v;
        std::uint32_t* pending = &pending_[depths_.texel(reach.firstColumn, row)];
        Int4 columns = Int4{0, 1, 2, 3} + reach.firstColumn;
        for (int column = reach.firstColumn; column < reach.endColumn; column += 4, columns += 4, pending += 4) {
            const Int4 change = changesWithin(impact, columns, dv * dv) & (columns < reach.endColumn);
            Unsigned4 sum;
            std::memcpy(&sum, pending, sizeof sum);
            sum = lanes::atMost(sum + Unsigned4(change), Unsigned4{} + DepthMap::bottom);
            lanes::store(pending, sum);
        }
    }
}

/// Hits in the order of tiles of the surface: neighbours in the list are neighbours in memory.
std::span<const Impact> WornSurface::sortedByTile(std::span<const Impact> impacts) {
    const auto tilesAcross = static_cast<std::size_t>(depths_.columns() / tileTexels + 1);
    const auto tileOf = [&](const Impact& impact) {
        const int column = std::clamp(static_cast<int>(impact.u), 0, depths_.columns() - 1);
        const int row = std::clamp(static_cast<int>(impact.v), 0, depths_.rows() - 1);
        return static_cast<std::size_t>(row / tileTexels) * tilesAcross + static_cast<std::size_t>(column / tileTexels);
    };
    tileEnds_.assign(tilesAcross * static_cast<std::size_t>(depths_.rows() / tileTexels + 1) + 1, 0);
    for (const Impact& impact : impacts) ++tileEnds_[tileOf(impact) + 1];
    std::partial_sum(tileEnds_.begin(), tileEnds_.end(), tileEnds_.begin());
    sorted_.resize(impacts.size());
    for (const Impact& impact : impacts) sorted_[tileEnds_[tileOf(impact)]++] = impact;
    return sorted_;
}

/// Of a hit on one texel.
[[gnu::always_inline]] inline void WornSurface::addDot(const Impact& impact, TexelRectangle& reach) {
    const int column = nearestTo(impact.u), row = nearestTo(impact.v);
    if (column < 0 || row < 0 || column >= depths_.columns() || row >= depths_.rows()) return;
    const std::size_t texel = depths_.texel(column, row);
    ++hits_[texel];
    addPending(texel, impact.depth);
    reach = {std::min(reach.firstColumn, column), std::min(reach.firstRow, row), std::max(reach.endColumn, column + 1),
             std::max(reach.endRow, row + 1)};
}

void WornSurface::scatter(std::span<const Impact> impacts) {
    TexelRectangle dots{depths_.columns(), depths_.rows(), 0, 0};  // empty
    for (const Impact& impact : isWorthSorting(impacts) ? sortedByTile(impacts) : impacts) {
        if (impact.radiusTexels <= 0) {
            addDot(impact, dots);
            continue;
        }
        const TexelRectangle reach = reachOf(impact, depths_);
        if (const std::size_t nearest = nearestTexel(impact, depths_); nearest < hits_.size()) ++hits_[nearest];
        waiting_ = joined(waiting_, reach);
        addPit(impact, reach);
    }
    waiting_ = joined(waiting_, dots);
}

/// Sorting costs as much as a few distant texels, so it pays off for many pits on a surface larger than a cache.
bool WornSurface::isWorthSorting(std::span<const Impact> impacts) const {
    return depths_.size() > nearTexels && impacts.size() >= fewHits && impacts.front().radiusTexels > 0;
}

template <typename Change>
void WornSurface::forEachPending(const Change& change) {
    for (int row = waiting_.firstRow; row < waiting_.endRow; ++row)
        for (int column = waiting_.firstColumn; column < waiting_.endColumn; ++column) {
            const std::size_t texel = depths_.texel(column, row);
            if (const std::uint32_t pending = std::exchange(pending_[texel], 0); pending > 0) change(texel, pending);
        }
    changed_ = joined(changed_, std::exchange(waiting_, {}));
}

void WornSurface::takeOff() {
    forEachPending([&](std::size_t texel, std::uint32_t pending) {
        std::uint32_t& depth = depths_.depths()[texel];
        const std::uint32_t taken = std::min(pending, DepthMap::bottom - depth);
        const std::uint32_t ofDeposit = std::min(taken, laid_[texel]);
        depth += taken;
        laid_[texel] -= ofDeposit;
        worn_[texel] += taken - ofDeposit;
        takenOff_ += taken;
    });
}

void WornSurface::layOn(const std::optional<Repose>& repose) {
    const TexelRectangle reach = waiting_;
    forEachPending([&](std::size_t texel, std::uint32_t pending) {
        std::uint32_t& depth = depths_.depths()[texel];
        const std::uint32_t laid = std::min(pending, depth);
        depth -= laid;
        laid_[texel] += laid;
        laidOn_ += laid;
    });
    if (repose) changed_ = joined(changed_, slide(depths_, laid_, reach, *repose));
}

}  // namespace dustbench::relief
