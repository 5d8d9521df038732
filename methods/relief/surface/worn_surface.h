// A relief that wears: its depths, and per texel the number of hits, the amount removed and the amount deposited.
//
// Two algorithms give the same bits. `gather` visits each texel and tests every hit, as in the paper; its cost is
// texels × hits. `scatter` visits each hit and writes the texels within its reach, four of a row at a time.
//
// Volumes: in steps of DepthMap times one texel. Exactly:
//
//     present = initial − takenOff + laidOn
//
// Owns: its columns, booked on a ledger. Threads: one at a time. Source: Bergeron, 3.4 (gather).
#pragma once

#include <cstdint>
#include <optional>
#include <span>

#include "methods/relief/surface/depth_map.h"
#include "methods/relief/surface/impact.h"
#include "methods/relief/surface/sliding.h"
#include "methods/relief/surface/texel_rectangle.h"

namespace dustbench::relief {

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
