// Octree construction by the search principle, in three variants: as in the paper, with cells computed in advance, and
// for bricks with a small grid each.
//
// Owns: its lists of particles and voxels, booked on a ledger. Threads: one, as in the paper; a reducer: one at a time.
// Source: Carr2006, 3.4, 3.5 and Fig. 3.
#pragma once

#include <array>
#include <cstdint>

#include "methods/contract/volume.h"
#include "methods/kit/octree/brick_builder.h"
#include "methods/kit/octree/octree.h"
#include "methods/kit/octree/octree_settings.h"
#include "methods/kit/octree/particle_cells.h"

namespace dustbench::octree_search {

/// As in the paper: for each particle, the bits of the coordinates lead level by level from the root to the voxel, and
/// missing nodes are created on the way. A separate traversal lists the voxels.
class PaperBuilder final : public octree::OctreeBuilder {
 public:
    explicit PaperBuilder(MemoryLedger& ledger)
        : active_(ledger.account("octree particle lists")), found_(ledger.account("octree voxels found")) {}

    std::int64_t build(const Puffs& store, const octree::Lattice& lattice, const octree::OctreeSettings& settings,
                       octree::Octree& tree) override;

    struct Voxel {
        octree::CellEntry entry;  ///< with the particle that represents it
        double massSquareMetres;
    };

 private:
    void insert(std::uint32_t particle, const octree::ParticlePlace& place, const octree::VoxelRule& rule,
                octree::Octree& tree);

    LedgerVector<std::uint32_t> active_;
    LedgerVector<Voxel> found_;
};

/// Derives each particle's path from its coordinates, follows it from the root and adds missing nodes; a separate
/// traversal lists the voxels.
class InsertionBuilder final : public octree::OctreeBuilder {
 public:
    explicit InsertionBuilder(MemoryLedger& ledger)
        : cells_(ledger),
          found_(ledger.account("octree voxels found")),
          foundMasses_(ledger.account("octree voxels found")) {}

    std::int64_t build(const Puffs& store, const octree::Lattice& lattice, const octree::OctreeSettings& settings,
                       octree::Octree& tree) override;

 private:
    std::size_t insertAll(const octree::VoxelRule& rule, octree::Octree& tree);
    void list(std::size_t count, bool withMasses, octree::Octree& tree) const;

    octree::ParticleCells cells_;
    octree::ReusedArray<octree::CellEntry> found_;
    octree::ReusedArray<double> foundMasses_;
};

/// Reduces a brick's particles to voxels through a small dense grid of cells: the search principle with a single
/// address as the path.
class GridReducer {
 public:
    static constexpr bool needsSpare = false;

    explicit GridReducer(const octree::VoxelRule& rule) : rule_(rule) {}

    /// Called by BrickBuilder.
    void reduce(const octree::BrickPartition& partition, const octree::Brick& brick, const octree::BrickVoxels& voxels);

 private:
    octree::VoxelRule rule_;
    /// By place: the best particle's key; 0: none. Keys are never 0.
    std::array<std::uint64_t, octree::placesInBrick> best_{};
    static constexpr std::size_t bits = 64 * std::tuple_size_v<octree::PlaceBits>;
    std::array<std::uint8_t, bits> isTaken_{};    ///< by place: whether `best_` has a key; an eighth of its size
    std::array<std::uint16_t, bits + 31> taken_;  ///< the places that have a key
    std::array<double, octree::placesInBrick> sums_;
};

}  // namespace dustbench::octree_search
