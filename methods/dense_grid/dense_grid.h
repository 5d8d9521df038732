// A dense grid instead of the octree, which shows the memory that an octree saves: every cell of the world's cube
// exists in memory, with or without dust.
//
// Finds the voxels that an octree has at its finest level (levels = 1). Cells are stored in Morton order, so that the
// traversal lists voxels in the octree's order.
//
// Owns: the cells, booked on a ledger: 8^depth of `cellBytes`. Threads: one.
// Source: Carr2006, 2.3 (a volume buffer, O(n³) of memory).
#pragma once

#include <cstdint>

#include "methods/contract/volume.h"
#include "methods/kit/octree/octree.h"

namespace dustbench::dense_grid {

/// Bytes of one cell: the particle that represents it, and its mass where masses are accumulated.
[[nodiscard]] constexpr std::uint64_t cellBytes(octree::OpacityPolicy policy) {
    return sizeof(std::uint32_t) + (policy == octree::OpacityPolicy::accumulate ? sizeof(double) : 0);
}
/// Bytes of all cells.
[[nodiscard]] constexpr std::uint64_t gridBytes(int depth, octree::OpacityPolicy policy) {
    return cellBytes(policy) << 3 * depth;
}

class GridBuilder final : public octree::OctreeBuilder {
 public:
    explicit GridBuilder(MemoryLedger& ledger);

    /// Fills the list of voxels; the tree gets no nodes. Ignores `settings.levels`.
    std::int64_t build(const Puffs& store, const octree::Lattice& lattice, const octree::OctreeSettings& settings,
                       octree::Octree& tree) override;
    [[nodiscard]] std::size_t structureBytes(const octree::Octree& tree) const override;

 private:
    void clear(int depth, bool withMasses);
    void list(octree::Octree& tree) const;

    LedgerVector<std::uint32_t> active_;
    LedgerVector<std::uint32_t> cells_;  ///< by Morton code: particle + 1; 0: empty
    LedgerVector<double> masses_;        ///< by Morton code; empty unless accumulated
};

}  // namespace dustbench::dense_grid
