// The result of a voxeliser: the voxels that belong to the shape, and their colours.
//
// Colours: linear RGB. Owns: its arrays.
#pragma once

#include <algorithm>
#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "methods/voxel_shape/voxels/lattice.h"

namespace dustbench::voxel_shape {

struct MarkedVoxels {
    explicit MarkedVoxels(const Lattice& where)
        : lattice(where), marked(where.size(), 0), colours(where.size(), glm::vec3(0)) {}

    [[nodiscard]] std::size_t count() const {
        return static_cast<std::size_t>(std::count_if(marked.begin(), marked.end(), [](auto m) { return m != 0; }));
    }

    Lattice lattice;
    std::vector<std::uint8_t> marked;  ///< 1: part of the shape
    std::vector<glm::vec3> colours;    ///< of the marked voxels
};

}  // namespace dustbench::voxel_shape
