// The stress of a solid made of a shape's voxels under a load, and its colour.
//
//     div σ + f = 0,  σ = λ·tr ε·1 + 2µ·ε,  ε: symmetric gradient of the displacements
//
// Each active voxel is a trilinear hexahedron with eight points of integration; the linear system is solved by
// conjugate gradients with the diagonal as preconditioner. A load given as a force causes a stress that does not depend
// on Young's modulus, which therefore is 1.
//
// Units: m, N, Pa. Frame: the shape's own. Threads: one caller; uses the current oneTBB arena; the result does not
// depend on the number of threads. Source: Hughes2000, 3.1 and 3.3 (element); Shewchuk1994, B3 (solver).
#pragma once

#include <glm/glm.hpp>
#include <string>
#include <vector>

#include "methods/voxel_shape/voxels/voxel_grid.h"

namespace dustbench::voxel_shape {

/// A box that contains the centres of voxels.
struct VoxelBox {
    glm::vec3 minimum{0}, maximum{0};

    [[nodiscard]] bool contains(const glm::vec3& point) const {
        return glm::all(glm::greaterThanEqual(point, minimum)) && glm::all(glm::lessThanEqual(point, maximum));
    }
};

struct ElasticLoad {
    std::string where;      ///< prefix of messages: `girder.toml:31: `
    VoxelBox held;          ///< voxels that do not move
    VoxelBox loaded;        ///< voxels that share the force
    glm::vec3 newtons{0};   ///< (0, 0, 0): no load
    double poisson = 0.3;   ///< Poisson's ratio
    float fullPascals = 0;  ///< von Mises stress of the full colour; 0: the maximum
    glm::vec3 colour{0.9f, 0.05f, 0.02f};

    [[nodiscard]] bool isOn() const { return newtons != glm::vec3(0); }
};

/// The von Mises stress at the centre of each of `grid.active()`, in Pa. Throws InputError if a box contains no active
/// voxel, or if nothing holds the loaded voxels: a chain of voxels that share faces must connect them to held ones.
[[nodiscard]] std::vector<double> stressUnder(const ElasticLoad& load, const VoxelGrid& grid);

/// Mixes the colours of the active voxels, inside and fading, with the load's colour by their stress.
void showStress(const ElasticLoad& load, VoxelGrid& grid);

}  // namespace dustbench::voxel_shape
