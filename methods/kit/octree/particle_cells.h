// The active particles with their cells and levels: as a list of packed words, the first step of a faithful build, or
// one particle at a time.
//
// Frame: world. Threads: parallel over fixed blocks; the result does not depend on the number of threads.
// Source: Carr2006, 3.3 and 3.4, step 1. Departs: the paper does not state the ages at which a particle moves up a
// level.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <span>

#include "methods/contract/volume.h"
#include "methods/kit/memory/memory_ledger.h"
#include "methods/kit/octree/cell_kernel.h"
#include "methods/kit/octree/lattice.h"
#include "methods/kit/octree/octree.h"
#include "methods/kit/octree/octree_settings.h"

namespace dustbench::octree {

/// Entries in store order. Particles outside the world have no entry, but are counted.
class DUSTBENCH_API ParticleCells {
 public:
    explicit ParticleCells(MemoryLedger& ledger);

    /// Throws like `checkPositions` and `checkCount` (cell_kernel.h).
    void find(const Puffs& store, const Lattice& lattice, const OctreeSettings& settings);

    [[nodiscard]] std::span<const CellEntry> entries() const { return {entries_.data(), count_}; }
    [[nodiscard]] std::int64_t clipped() const { return clipped_; }

 private:
    template <LevelRule rule>
    void fill(const Puffs& store, const Lattice& lattice, const OctreeSettings& settings);

    ReusedArray<CellEntry> entries_;
    ReusedArray<std::uint32_t> blockSizes_;
    std::size_t count_ = 0;
    std::int64_t clipped_ = 0;
};

/// The position of a particle in finest cells, and the level of its voxel, for builders that process one particle at a
/// time. The arithmetic is that of CellKernel, so the voxels are the same. Cells count from the world's origin, not
/// from the octree's corner.
class ParticlePlace {
 public:
    ParticlePlace(const Puffs& store, const Lattice& lattice, const OctreeSettings& settings)
        : store_(store),
          settings_(settings),
          cellsPerMetre_(static_cast<float>(lattice.cellsPerEdge() / lattice.edgeMetres)),
          finestEdge_(static_cast<float>(lattice.cellEdgeMetres(lattice.depth))),
          corner_(lattice.firstCell()),
          edge_(lattice.cellsPerEdge()) {}

    /// Coordinates of a particle.
    [[nodiscard]] glm::dvec3 cells(std::size_t i) const { return store_.position(i) * cellsPerMetre_; }
    /// Minimum corner of the octree's world, and its edge.
    [[nodiscard]] const glm::dvec3& corner() const { return corner_; }
    [[nodiscard]] double edge() const { return edge_; }
    /// False for NaN.
    [[nodiscard]] bool isInside(std::size_t i) const {
        const glm::dvec3 p = cells(i);
        return glm::all(glm::greaterThanEqual(p, corner_)) && glm::all(glm::lessThan(p, corner_ + edge_));
    }

    /// Level of the particle's voxel: `depth` is the finest, 0 the root.
    [[nodiscard]] int level(std::size_t i) const {
        const std::uint32_t rise =
            settings_.levelRule == LevelRule::age
                ? riseByAge(store_.age[i], store_.lifetime[i], static_cast<float>(settings_.levels))
                : riseByRadius(store_.radius[i], finestEdge_, static_cast<std::uint32_t>(settings_.levels));
        return settings_.depth - static_cast<int>(rise);
    }

 private:
    const Puffs& store_;
    const OctreeSettings& settings_;
    float cellsPerMetre_, finestEdge_;
    glm::dvec3 corner_;
    double edge_;
};

/// Fills `active` with the particles inside the world, in store order; returns the number of all others. Throws like
/// `checkCount` and `checkPositions` (cell_kernel.h).
DUSTBENCH_API std::int64_t listActive(const Puffs& store, const ParticlePlace& place,
                                      LedgerVector<std::uint32_t>& active);

}  // namespace dustbench::octree
