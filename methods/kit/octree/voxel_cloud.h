// The voxels of an octree as drawable primitives: one column per attribute, in tree order.
//
// Units: metres, m², seconds. Frame: world. Colours: linear RGB. Owns: its columns, booked on a ledger. Threads: filled
// in parallel.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>

#include "methods/contract/volume.h"
#include "methods/kit/draw/puff_noise.h"
#include "methods/kit/memory/memory_ledger.h"
#include "methods/kit/octree/lattice.h"
#include "methods/kit/octree/octree.h"
#include "methods/kit/octree/octree_settings.h"

namespace dustbench::octree {

struct VoxelCloud {
    explicit VoxelCloud(MemoryLedger& ledger);

    /// Lists the voxels of `tree` with the mass and colour of the particle that represents each, or with the summed
    /// mass.
    void take(const Octree& tree, const Puffs& store, const VoxelRule& rule, const Lattice& treeLattice,
              const draw::NoiseSettings& noiseOfPuffs = {});
    void resize(std::size_t count, bool coloured);
    void clear() {
        resize(0, false);
        noise.clear();
    }
    [[nodiscard]] std::size_t size() const { return place.size(); }
    /// Sets the columns that derive from the place.
    void locate(std::size_t i);
    [[nodiscard]] bool coloured() const { return !red.empty(); }
    [[nodiscard]] int rise(std::size_t i) const { return 15 - static_cast<int>(place[i] & 15); }
    [[nodiscard]] std::uint64_t code(std::size_t i) const { return place[i] >> 4; }
    /// Optical depth through the voxel along an axis.
    [[nodiscard]] float opticalDepth(std::size_t i) const { return mass[i] / (edge[i] * edge[i]); }
    [[nodiscard]] float extinctionPerMetre(std::size_t i) const { return opticalDepth(i) / edge[i]; }

    Lattice lattice;
    LedgerVector<std::uint64_t> place;  ///< CellEntry::place, ascending
    LedgerVector<float> x, y, z, edge;  ///< centre; edge
    LedgerVector<float> mass;           ///< τ·2π·s², of the representing particle or summed
    LedgerVector<float> age;
    LedgerVector<float> red, green, blue;  ///< empty if all share one colour
    LedgerVector<draw::NoisePlace> noise;  ///< that of the representing particle, at the voxel's centre; empty if off
};

/// The voxels of two clouds, each with a mass between those that it has in the two:
///
///     m = m_from + share·(m_to − m_from), where a voxel that a cloud does not have has no mass there
///
/// Owns scratch memory, booked on a ledger. Threads: one.
class VoxelMix {
 public:
    explicit VoxelMix(MemoryLedger& ledger) : moved_(ledger), order_(ledger.account("voxel list")) {}

    /// Replaces `mixed`. The places of both clouds must ascend, and those of `mixed` do. `from` is moved to the lattice
    /// of `to` if the world has moved, and then lacks the voxels that are outside of it. Voxels that `to` does not have
    /// are left out if their optical depth is below `dropBelow`.
    void mix(VoxelCloud& from, const VoxelCloud& to, float share, float dropBelow, VoxelCloud& mixed);

 private:
    void moveTo(const Lattice& lattice, VoxelCloud& cloud);

    VoxelCloud moved_;
    LedgerVector<std::uint32_t> order_;
};

/// Cross-fades voxels between frames: a voxel's mass follows that of the octree with a time constant, so that no voxel
/// pops in or out.
///
///     m ← m + (1 − exp(−Δt/T))·(m_octree − m)
///
/// Owns the faded voxels, booked on a ledger. Threads: one.
/// Source: Carr2006, 5 (future work: "interpolating or cross-fading between frames"). Departs: the formula is ours.
class CrossFade {
 public:
    CrossFade(MemoryLedger& ledger, double timeConstantSeconds);

    /// Advances by one frame towards `target`, whose places must ascend. Returns the voxels to draw, in the same order.
    /// The first call returns a copy of the target. If the world has moved, voxels outside of it are dropped.
    const VoxelCloud& follow(const VoxelCloud& target, double stepSeconds);

 private:
    double timeConstantSeconds_;
    bool first_ = true;
    VoxelCloud shown_, next_;
    VoxelMix mix_;
};

/// Keeps the voxels of a tree for a while, and shows those between the last two trees, one interval later:
///
///     m = m_before + s·(m_last − m_before), s: share of the interval since the last tree was built
///
/// Owns the voxels of both trees and those between them, booked on a ledger. Threads: one.
/// Source: Carr2006, 5 (future work: "storing the volumetric structure from frame to frame, and interpolating").
/// Departs: the formula is ours.
class KeptVoxels {
 public:
    /// `keepSeconds`: the interval, rounded up to whole frames; above 0.
    KeptVoxels(MemoryLedger& ledger, double keepSeconds);

    /// Advances by one frame. Returns true if a tree is due: `take` must follow with its voxels.
    bool advance(double stepSeconds);
    /// Exchanges `built`, whose places must ascend, for the voxels of the tree before the last.
    void take(VoxelCloud& built);
    /// The voxels to draw.
    const VoxelCloud& between();

 private:
    double keepSeconds_;
    double intervalSeconds_ = 0;  ///< in whole frames
    double sinceSeconds_ = 0;     ///< the last tree was built
    int trees_ = 0;               ///< 0, 1, or more
    VoxelCloud before_, last_, between_;
    VoxelMix mix_;
};

}  // namespace dustbench::octree
