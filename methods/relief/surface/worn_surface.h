// A relief that wears: its depths, and per texel the number of hits, the amount removed and the amount deposited.
//
// Two algorithms give the same bits. `gather` visits each texel and tests every hit, as in the paper; its cost is
// texels × hits. `scatter` visits each hit and writes the texels within its reach, four of a row at a time.
//
// Units: u, v in texels; depths in steps of DepthMap; volumes in such steps times one texel. Exactly:
//
//     present = initial − takenOff + laidOn
//
// Owns: its columns, booked on a ledger. Threads: one at a time. Source: Bergeron, 3.4 (gather).
#pragma once

#include <cmath>
#include <cstdint>
#include <optional>
#include <span>

#include "methods/relief/surface/depth_map.h"
#include "methods/relief/surface/sliding.h"

namespace dustbench::relief {

/// One hit of a particle on a relief.
struct Impact {
    float u = 0, v = 0;       ///< texels
    float radiusTexels = 0;   ///< of the changed area; 0: only the nearest texel
    std::uint32_t depth = 0;  ///< change at the centre
};

/// h(ρ) = h₀·(1 − ρ²/r²) of an impact with a radius. Whole steps, so that sums do not depend on the order of the hits.
[[nodiscard]] inline std::uint32_t changeWithin(const Impact& impact, int column, int row) {
    const float du = static_cast<float>(column) - impact.u, dv = static_cast<float>(row) - impact.v;
    const float share = 1 - (du * du + dv * dv) / (impact.radiusTexels * impact.radiusTexels);
    // A signed number of the same value, which processors convert faster; depths end at 2³⁰.
    return static_cast<std::uint32_t>(
        static_cast<std::int32_t>(static_cast<double>(share > 0 ? share : 0) * impact.depth));
}

/// A paraboloid about the hit, or one texel.
[[nodiscard]] inline std::uint32_t changeAt(const Impact& impact, int column, int row) {
    if (impact.radiusTexels > 0) return changeWithin(impact, column, row);
    return std::lround(impact.u) == column && std::lround(impact.v) == row ? impact.depth : 0;
}

class WornSurface {
 public:
    WornSurface(const scene::Relief& relief, MemoryLedger& ledger);

    /// Adds the changes of all hits to the pending ones, limited to `DepthMap::bottom`.
    void gather(std::span<const Impact> impacts);
    void scatter(std::span<const Impact> impacts);

    /// Removes the pending amount, down to the bottom: first deposited material, then the surface itself.
    void takeOff();
    /// Deposits the pending amount, up to the face. With `repose` it slides down where it is steeper.
    void layOn(const std::optional<Repose>& repose = {});

    [[nodiscard]] const DepthMap& depths() const { return depths_; }
    [[nodiscard]] std::span<const std::uint32_t> hits() const { return hits_; }
    [[nodiscard]] std::span<const std::uint32_t> worn() const { return worn_; }  ///< of the surface itself
    [[nodiscard]] std::span<const std::uint32_t> laid() const { return laid_; }  ///< deposited on it

    [[nodiscard]] std::uint64_t takenOffVolume() const { return takenOff_; }
    [[nodiscard]] std::uint64_t laidOnVolume() const { return laidOn_; }
    /// The volume above the bottom, from the current depths.
    [[nodiscard]] std::uint64_t presentVolume() const;
    [[nodiscard]] std::uint64_t initialVolume() const { return initial_; }

    /// Returns the texels changed since the last call.
    [[nodiscard]] TexelRectangle takeChanged();

 private:
    void addPending(std::size_t texel, std::uint32_t change);
    void gatherAt(int column, int row, std::span<const Impact> impacts);
    void addPit(const Impact& impact, const TexelRectangle& reach);
    void addDot(const Impact& impact, TexelRectangle& reach);
    [[nodiscard]] bool isWorthSorting(std::span<const Impact> impacts) const;
    [[nodiscard]] std::span<const Impact> sortedByTile(std::span<const Impact> impacts);
    template <typename Change>
    void forEachPending(const Change& change);

    DepthMap depths_;
    LedgerVector<std::uint32_t> hits_, worn_, laid_, pending_;
    LedgerVector<Impact> sorted_;
    LedgerVector<std::uint32_t> tileEnds_;
    TexelRectangle waiting_;  ///< texels with a pending amount
    TexelRectangle changed_;
    std::uint64_t initial_ = 0, takenOff_ = 0, laidOn_ = 0;
};

}  // namespace dustbench::relief
