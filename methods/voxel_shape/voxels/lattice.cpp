#include "methods/voxel_shape/voxels/lattice.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "methods/contract/errors.h"

namespace dustbench::voxel_shape {
namespace {

/// Distance of the mesh from the lattice's boundary as a share of a voxel, so that rounding puts no vertex outside.
constexpr float rim = 1e-3f;

}  // namespace

void requireSoundMesh(const scene::Mesh& mesh, const char* what) {
    const std::string name(what);
    if (mesh.indices.size() < 3) throw InputError(name + ": got a mesh without triangles, expected at least one");
    for (const std::uint32_t index : mesh.indices)
        if (index >= mesh.positions.size())
            throw InputError(name + ": a triangle uses vertex " + std::to_string(index) + ", allowed: 0.." +
                             std::to_string(static_cast<std::int64_t>(mesh.positions.size()) - 1));
    for (std::size_t i = 0; i < mesh.positions.size(); ++i)
        for (int axis = 0; axis < 3; ++axis)
            if (!std::isfinite(mesh.positions[i][axis]))
                throw InputError(name + ": vertex " + std::to_string(i) + " is not a finite point");
}

Lattice latticeAround(const scene::Mesh& mesh, int resolution) {
    if (resolution < 1 || resolution > maximumVoxelsASide)
        throw InputError("voxel resolution: got " + std::to_string(resolution) + ", allowed: 1.." +
                         std::to_string(maximumVoxelsASide));
    requireSoundMesh(mesh, "voxels of a mesh");
    glm::vec3 minimum(INFINITY), maximum(-INFINITY);
    for (const std::uint32_t index : mesh.indices) {
        minimum = glm::min(minimum, mesh.positions[index]);
        maximum = glm::max(maximum, mesh.positions[index]);
    }
    const glm::vec3 extent = maximum - minimum;
    const float longest = std::max({extent.x, extent.y, extent.z});
    if (!(longest > 0) || !std::isfinite(longest))
        throw InputError("voxels of a mesh: its longest side is " + std::to_string(longest) +
                         " m, expected a finite length above 0");
    Lattice lattice;
    lattice.edgeMetres = longest / (static_cast<float>(resolution) - 2 * rim);
    for (int axis = 0; axis < 3; ++axis)
        lattice.counts[axis] =
            std::clamp(static_cast<int>(std::ceil(extent[axis] / lattice.edgeMetres + 2 * rim)), 1, resolution);
    lattice.origin = (minimum + maximum) / 2.0f - lattice.edgeMetres / 2 * glm::vec3(lattice.counts);
    return lattice;
}

}  // namespace dustbench::voxel_shape
