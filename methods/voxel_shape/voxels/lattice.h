// The lattice of a shape's voxels: cubes of equal edge in a box, the cell that contains a point, and the cells that a
// voxeliser marks.
//
// Units: metres; colours: linear RGB. Frame: the shape's own. Threads: const members are safe from any.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "methods/contract/solid.h"

namespace dustbench::voxel_shape {

inline constexpr int maximumVoxelsASide = 256;

struct Lattice {
    glm::ivec3 counts{1};  ///< voxels along x, y, z
    glm::vec3 origin{0};   ///< minimum corner
    float edgeMetres = 1;  ///< edge of a voxel

    [[nodiscard]] std::size_t size() const {
        return static_cast<std::size_t>(counts.x) * static_cast<std::size_t>(counts.y) *
               static_cast<std::size_t>(counts.z);
    }
    /// x is the fastest index, z the slowest.
    [[nodiscard]] std::uint32_t index(const glm::ivec3& cell) const {
        return static_cast<std::uint32_t>((cell.z * counts.y + cell.y) * counts.x + cell.x);
    }
    [[nodiscard]] glm::ivec3 cell(std::uint32_t index) const {
        const int i = static_cast<int>(index);
        return {i % counts.x, i / counts.x % counts.y, i / counts.x / counts.y};
    }
    [[nodiscard]] bool contains(const glm::ivec3& cell) const {
        return cell.x >= 0 && cell.y >= 0 && cell.z >= 0 && cell.x < counts.x && cell.y < counts.y && cell.z < counts.z;
    }
    [[nodiscard]] glm::vec3 centre(const glm::ivec3& cell) const {
        return origin + edgeMetres * (glm::vec3(cell) + 0.5f);
    }
    /// Converts to voxels from the minimum corner.
    [[nodiscard]] glm::vec3 toVoxels(const glm::vec3& point) const { return (point - origin) / edgeMetres; }
    [[nodiscard]] glm::vec3 maximumCorner() const { return origin + edgeMetres * glm::vec3(counts); }
};

/// Throws InputError, naming `what`, if the mesh has no triangles, an index without a vertex, or a vertex that is not
/// finite.
void requireSoundMesh(const scene::Mesh& mesh, const char* what);

/// Returns the lattice that holds a mesh with `resolution` voxels along its longest side and as many as needed along
/// the others. Throws InputError if the mesh is not sound or has no extent, or the resolution is outside 1..256.
[[nodiscard]] Lattice latticeAround(const scene::Mesh& mesh, int resolution);

/// The result of a voxeliser: the voxels that belong to the shape, and their colours.
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
