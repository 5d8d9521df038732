// Which points are in or near a solid: a grid of yes and no about its mesh, to look up in one step.
//
// A cell says yes where the solid, its inside included, comes within `reach` of the cell's middle; some more do, none
// less. So a voxel whose middle finds no is clear of the solid where `reach` is at least half the voxel's diagonal and
// half a cell's.
//
// Units: metres. Frame: the solid's own. Owns: its cells, a byte each. Threads: const members are safe from any.
#pragma once

#include <vector>

#include "methods/voxel_shape/voxels/lattice.h"

namespace dustbench::voxel_shape {

class Nearness {
 public:
    /// Cells of `cellMetres`, coarser where more than 128 would lie along the mesh's longest side. Beyond half a cell's
    /// diagonal, which is added, `reachMetres` is what callers want. A mesh that
    /// encloses nothing has its surface alone.
    Nearness(const scene::Mesh& mesh, float cellMetres, float reachMetres);

    [[nodiscard]] const Lattice& lattice() const { return lattice_; }
    /// `place` in cells from the lattice's minimum corner.
    [[nodiscard]] bool at(const glm::vec3& place) const {
        // NaN and far away are no; negative shares must not be rounded towards 0.
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
