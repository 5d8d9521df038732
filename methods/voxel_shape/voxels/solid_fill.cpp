#include "methods/voxel_shape/voxels/solid_fill.h"

#include <algorithm>
#include <array>
#include <string>
#include <utility>
#include <vector>

#include "methods/shared/errors.h"

namespace dustbench::voxel_shape {
namespace {

constexpr std::array<glm::ivec3, 6> steps{{{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}}};

/// Goes from `front` on to every cell that `take(cell, from)` accepts, nearest first.
template <typename Take>
void spread(const Lattice& lattice, std::vector<std::uint32_t> front, const Take& take) {
    std::vector<std::uint32_t> next;
    while (!front.empty()) {
        next.clear();
        for (const std::uint32_t from : front) {
            const glm::ivec3 cell = lattice.cell(from);
            for (const glm::ivec3& step : steps) {
                if (!lattice.contains(cell + step)) continue;
                const std::uint32_t to = lattice.index(cell + step);
                if (take(to, from)) next.push_back(to);
            }
        }
        std::swap(front, next);
    }
}

/// 1 where a cell can be reached from the lattice's rim through unmarked cells.
std::vector<std::uint8_t> reachedFromOutside(const MarkedVoxels& surface) {
    const Lattice& lattice = surface.lattice;
    std::vector<std::uint8_t> reached(lattice.size(), 0);
    std::vector<std::uint32_t> front;
    const auto take = [&](std::uint32_t cell, std::uint32_t) {
        if (surface.marked[cell] || reached[cell]) return false;
        reached[cell] = 1;
        return true;
    };
    for (std::uint32_t i = 0; i < lattice.size(); ++i) {
        const glm::ivec3 cell = lattice.cell(i);
        const bool rim = glm::any(glm::equal(cell, glm::ivec3(0))) || glm::any(glm::equal(cell, lattice.counts - 1));
        if (rim && take(i, i)) front.push_back(i);
    }
    spread(lattice, std::move(front), take);
    return reached;
}

}  // namespace

std::size_t openEdges(const scene::Mesh& mesh) {
    // Corners at one place become one number: their rank among all places.
    const auto less = [](const glm::vec3& a, const glm::vec3& b) {
        return std::array{a.x, a.y, a.z} < std::array{b.x, b.y, b.z};
    };
    std::vector<glm::vec3> places(mesh.positions);
    std::sort(places.begin(), places.end(), less);
    std::vector<std::pair<std::ptrdiff_t, std::ptrdiff_t>> edges;
    edges.reserve(mesh.indices.size());
    const auto rank = [&](std::size_t corner) {
        return std::lower_bound(places.begin(), places.end(), mesh.positions[mesh.indices[corner]], less) -
               places.begin();
    };
    for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3)
        for (std::size_t k = 0; k < 3; ++k) {
            const std::ptrdiff_t a = rank(i + k), b = rank(i + (k + 1) % 3);
            if (a != b) edges.emplace_back(std::min(a, b), std::max(a, b));
        }
    std::sort(edges.begin(), edges.end());
    std::size_t open = 0;
    for (std::size_t i = 0; i < edges.size();) {
        std::size_t same = i;
        while (same < edges.size() && edges[same] == edges[i]) ++same;
        open += (same - i) % 2;
        i = same;
    }
    return open;
}

bool fillInside(MarkedVoxels& surface) {
    const std::vector<std::uint8_t> outside = reachedFromOutside(surface);
    std::vector<std::uint32_t> front;
    bool any = false;
    for (std::uint32_t i = 0; i < outside.size(); ++i) {
        if (surface.marked[i])
            front.push_back(i);
        else
            any = any || !outside[i];
    }
    if (!any) return false;
    spread(surface.lattice, std::move(front), [&](std::uint32_t cell, std::uint32_t from) {
        if (surface.marked[cell] || outside[cell]) return false;
        surface.marked[cell] = 1;
        surface.colours[cell] = surface.colours[from];
        return true;
    });
    return true;
}

void fillSolid(MarkedVoxels& surface, const scene::Mesh& mesh) {
    if (fillInside(surface)) return;
    if (const std::size_t open = openEdges(mesh); open > 0)
        throw InputError("solid voxels: the mesh is open (" + std::to_string(open) +
                         " edges of one triangle alone) and encloses nothing at this resolution; allowed: a closed "
                         "mesh, holes narrower than a voxel, or fill = \"surface\"");
}

}  // namespace dustbench::voxel_shape
