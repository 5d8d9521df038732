#include "methods/relief/surface/worn_surface.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace dustbench::relief {
WornSurface::WornSurface(const scene::Relief& relief, MemoryLedger& ledger)
    : depths_(relief, ledger),
      hits_(ledger.account("relief hits")),
      worn_(ledger.account("relief wear")),
      laid_(ledger.account("relief deposit")),
      pending_(ledger.account("relief pending")) {
    for (LedgerVector<std::uint32_t>* column : {&hits_, &worn_, &laid_, &pending_}) column->resize(depths_.size());
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

void WornSurface::include(const TexelRectangle& reach) {
    waiting_ = joined(waiting_, reach);
}

TexelRectangle WornSurface::reachOf(const Impact& impact) const {
    const double reach = std::max(0.5, static_cast<double>(impact.radiusTexels));
    const auto clamped = [](double texel, int size) {
        return static_cast<int>(std::clamp(texel, 0.0, static_cast<double>(size)));
    };
    const auto u = static_cast<double>(impact.u), v = static_cast<double>(impact.v);
    return {clamped(std::floor(u - reach), depths_.columns()), clamped(std::floor(v - reach), depths_.rows()),
            clamped(std::floor(u + reach) + 1, depths_.columns()), clamped(std::floor(v + reach) + 1, depths_.rows())};
}

void WornSurface::gather(std::span<const Impact> impacts) {
    for (int row = 0; row < depths_.rows(); ++row)
        for (int column = 0; column < depths_.columns(); ++column) {
            const std::size_t texel = depths_.texel(column, row);
            for (const Impact& impact : impacts) {
                addPending(texel, changeAt(impact, column, row));
                hits_[texel] += std::lround(impact.u) == column && std::lround(impact.v) == row ? 1 : 0;
            }
        }
    if (!impacts.empty()) include({0, 0, depths_.columns(), depths_.rows()});
}

/// Adds the hit, and the depth of an impact on one texel, to the texel nearest to it.
void WornSurface::addToNearest(const Impact& impact) {
    const auto column = static_cast<int>(std::lround(impact.u)), row = static_cast<int>(std::lround(impact.v));
    if (column < 0 || row < 0 || column >= depths_.columns() || row >= depths_.rows()) return;
    const std::size_t texel = depths_.texel(column, row);
    ++hits_[texel];
    if (impact.radiusTexels > 0) return;
    addPending(texel, impact.depth);
    include({column, row, column + 1, row + 1});
}

void WornSurface::scatter(std::span<const Impact> impacts) {
    for (const Impact& impact : impacts) {
        addToNearest(impact);
        if (impact.radiusTexels <= 0) continue;
        const TexelRectangle reach = reachOf(impact);
        for (int row = reach.firstRow; row < reach.endRow; ++row) {
            std::uint32_t* pending = &pending_[depths_.texel(0, row)];
            for (int column = reach.firstColumn; column < reach.endColumn; ++column)
                pending[column] = std::min(DepthMap::bottom, pending[column] + changeWithin(impact, column, row));
        }
        include(reach);
    }
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
