// A relief that wears: its depths, and for each texel how often it was hit, what was taken off and what was laid on.
//
// Two ways to age it give the same bits. `gather` visits each texel and looks at each hit, as in the paper; its cost is
// texels × hits. `scatter` visits each hit and writes the texels within its reach.
//
// Volumes: in steps of DepthMap times one texel. removed, laid on and present volume obey, exactly,
//
//     present = initial − takenOff + laidOn
//
// Owns: its columns, booked on a ledger. Threads: one at a time. Source: Bergeron, 3.4 (gather).
#pragma once

#include <cstdint>
#include <span>

#include "methods/relief/surface/depth_map.h"
#include "methods/relief/surface/impact.h"

namespace dustbench::relief {

/// Texels [firstColumn, endColumn) × [firstRow, endRow).
struct TexelRectangle {
    int firstColumn = 0, firstRow = 0, endColumn = 0, endRow = 0;

    [[nodiscard]] bool empty() const { return firstColumn >= endColumn || firstRow >= endRow; }
};

class WornSurface {
 public:
    WornSurface(const scene::Relief& relief, MemoryLedger& ledger);

    /// Adds the changes of all hits to what is pending, which is limited to `DepthMap::bottom`.
    void gather(std::span<const Impact> impacts);
    void scatter(std::span<const Impact> impacts);

    /// Takes off what is pending, down to the bottom: first what was laid on, then the surface itself.
    void takeOff();
    /// Lays on what is pending, up to the face.
    void layOn();

    [[nodiscard]] const DepthMap& depths() const { return depths_; }
    [[nodiscard]] std::span<const std::uint32_t> hits() const { return hits_; }
    [[nodiscard]] std::span<const std::uint32_t> worn() const { return worn_; }  ///< of the surface itself
    [[nodiscard]] std::span<const std::uint32_t> laid() const { return laid_; }  ///< what lies on it

    [[nodiscard]] std::uint64_t takenOffVolume() const { return takenOff_; }
    [[nodiscard]] std::uint64_t laidOnVolume() const { return laidOn_; }
    /// Above the bottom, from the depths as they are.
    [[nodiscard]] std::uint64_t presentVolume() const;
    [[nodiscard]] std::uint64_t initialVolume() const { return initial_; }

    /// What changed since the last call.
    [[nodiscard]] TexelRectangle takeChanged();

 private:
    void addPending(std::size_t texel, std::uint32_t change);
    void include(const TexelRectangle& reach);
    [[nodiscard]] TexelRectangle reachOf(const Impact& impact) const;
    template <typename Change>
    void forEachPending(const Change& change);

    DepthMap depths_;
    LedgerVector<std::uint32_t> hits_, worn_, laid_, pending_;
    TexelRectangle waiting_;  ///< texels with something pending
    TexelRectangle changed_;
    std::uint64_t initial_ = 0, takenOff_ = 0, laidOn_ = 0;
};

}  // namespace dustbench::relief
