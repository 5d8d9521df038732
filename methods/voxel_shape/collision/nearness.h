// A grid of flags around a mesh: one look-up shows whether a point is in or near the solid.
//
// The flag of a cell is set if the solid, including its interior, comes within `reach` of the cell's centre. The test
// is conservative: some other cells are flagged too, but none is missed. A voxel whose centre lies in a cell without
// flag is therefore clear of the solid if `reach` is at least half the voxel's diagonal plus half the cell's.
//
// Units: metres. Frame: the solid's own. Owns: its cells, one byte each. Threads: const members are safe from any.
#pragma once

#include <vector>

#include "methods/voxel_shape/voxels/lattice.h"

namespace dustbench::voxel_shape {

class Nearness {
 public:
    /// Uses cells of `cellMetres`, or larger ones so that at most 128 fit along the mesh's longest side. `reachMetres`:
    /// the reach that callers need; half a cell's diagonal is added to it. A mesh that encloses nothing is represented
    /// by its surface only.
    Nearness(const scene::Mesh& mesh, float cellMetres, float reachMetres);

    [[nodiscard]] const Lattice& lattice() const { return lattice_; }
    /// `place` is in cells from the lattice's minimum corner.
    [[nodiscard]] bool at(const glm::vec3& place) const {
        // NaN and points outside the lattice are not near. Test before the cast, which rounds negative values towards
        // 0.
        if (!(place.x >= 0 && place.y >= 0 && place.z >= 0)) return false;
        const glm::vec3 counts(lattice_.counts);
        if (!(place.x < counts.x && place.y < counts.y && place.z < counts.z)) return false;
        return near_[lattice_.index(glm::ivec3(place))] != 0;
    }
    [[nodiscard]] std::size_t bytes() const { return near_.capacity(); }

 private:
    Lattice lattice_;
    std::vector<std::uint8_t> near_;
};

}  // namespace dustbench::voxel_shape
