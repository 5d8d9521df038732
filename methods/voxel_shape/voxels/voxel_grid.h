// The voxels of a shape as an array: a particle finds its voxel in one step.
//
// Memory: 64 bytes per voxel, active or not: force 16, colour 8, fading colour 8, size 4, fading size 4, lifetime 4,
// interpolation time 4, picture speed 4, maximum density 4, density 4, flags 4; and 4 per active voxel in the list.
// Units: metres. Frame: the shape's own. Owns: its arrays, on a ledger. Threads: const members are safe from any.
// Source: JuckelBeckhaus2007, 4.1 to 4.3.
#pragma once

#include <span>

#include "methods/kit/memory/memory_ledger.h"
#include "methods/voxel_shape/voxels/marked_voxels.h"
#include "methods/voxel_shape/voxels/voxel.h"

namespace dustbench::voxel_shape {

class VoxelGrid {
 public:
    /// Makes a grid without active voxels. Throws InputError if there is not enough memory.
    VoxelGrid(MemoryLedger& ledger, const Lattice& lattice);
    /// Makes the marked voxels active: copies of `pattern` with the marked colours.
    VoxelGrid(MemoryLedger& ledger, const MarkedVoxels& marked, const Voxel& pattern);

    [[nodiscard]] const Lattice& lattice() const { return lattice_; }
    [[nodiscard]] std::span<const Voxel> voxels() const { return voxels_; }
    [[nodiscard]] std::span<Voxel> voxels() { return voxels_; }
    [[nodiscard]] const Voxel& at(const glm::ivec3& cell) const { return voxels_[lattice_.index(cell)]; }
    [[nodiscard]] Voxel& at(const glm::ivec3& cell) { return voxels_[lattice_.index(cell)]; }

    /// Indices of the active voxels, ascending. Call `listActive` after voxels were activated or deactivated.
    [[nodiscard]] std::span<const std::uint32_t> active() const { return active_; }
    void listActive();
    /// Distributes this number of particles evenly over the active voxels as their maximum densities, and spreads the
    /// remainder. Throws InputError if no voxel is active.
    void shareOut(std::uint32_t particles);

    [[nodiscard]] std::uint64_t hash() const;

 private:
    Lattice lattice_;
    LedgerVector<Voxel> voxels_;
    LedgerVector<std::uint32_t> active_;
};

}  // namespace dustbench::voxel_shape
