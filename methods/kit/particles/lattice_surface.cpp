#include "methods/kit/particles/lattice_surface.h"

#include <algorithm>
#include <numeric>

namespace dustbench::particles {
namespace {

constexpr std::uint32_t missingNode = 0xffffffff;

}  // namespace

/// A side of a piece: the plane where the coordinate `fixed` is `at`; columns and rows run along two other axes.
struct LatticeSurface::Side {
    int fixed, at, across, down;

    [[nodiscard]] glm::ivec3 node(int column, int row) const {
        glm::ivec3 node(0);
        node[fixed] = at, node[across] = column, node[down] = row;
        return node;
    }
};

void LatticeSurface::addSide(const Side& side, const Lattice& lattice, std::span<const std::uint32_t> particleOf) {
    const int columns = lattice.points[side.across], rows = lattice.points[side.down];
    const auto particle = [&](int column, int row) {
        if (column < 0 || row < 0 || column >= columns || row >= rows) return missingNode;
        const glm::ivec3 n = side.node(column, row);
        return particleOf[static_cast<std::size_t>(n.x + lattice.points.x * (n.y + lattice.points.y * n.z))];
    };
    std::vector<std::uint32_t> vertexOf(static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows),
                                        missingNode);
    const auto place = [&](int column, int row) -> std::uint32_t& {
        return vertexOf[static_cast<std::size_t>(row) * static_cast<std::size_t>(columns) +
                        static_cast<std::size_t>(column)];
    };
    for (int row = 0; row < rows; ++row)
        for (int column = 0; column < columns; ++column) {
            const std::uint32_t self = particle(column, row);
            if (self == missingNode) continue;
            const auto orSelf = [&](std::uint32_t other) { return other == missingNode ? self : other; };
            place(column, row) = static_cast<std::uint32_t>(vertices_.size());
            vertices_.push_back({self,
                                 orSelf(particle(column - 1, row)),
                                 orSelf(particle(column + 1, row)),
                                 orSelf(particle(column, row - 1)),
                                 orSelf(particle(column, row + 1)),
                                 {column, row}});
        }
    for (int row = 0; row + 1 < rows; ++row)
        for (int column = 0; column + 1 < columns; ++column) {
            const std::uint32_t a = place(column, row), b = place(column + 1, row), c = place(column, row + 1),
                                d = place(column + 1, row + 1);
            if (a != missingNode && b != missingNode && c != missingNode)
                triangles_.insert(triangles_.end(), {a, b, c});
            if (b != missingNode && c != missingNode && d != missingNode)
                triangles_.insert(triangles_.end(), {b, d, c});
        }
}

bool LatticeSurface::follow(const Lattice& lattice, std::span<const std::uint64_t> serials) {
    if (std::ranges::equal(serials, serials_)) return false;
    serials_.assign(serials.begin(), serials.end());
    vertices_.clear();
    triangles_.clear();
    std::vector<std::uint32_t> order(serials.size());
    std::iota(order.begin(), order.end(), 0u);
    std::ranges::sort(order, {}, [&](std::uint32_t i) { return serials[i]; });

    const glm::ivec3 last = lattice.points - 1;
    std::vector<std::uint32_t> particleOf;
    for (std::size_t k = 0; k < order.size();) {
        const std::uint64_t piece = serials[order[k]] / lattice.size();
        particleOf.assign(lattice.size(), missingNode);
        for (; k < order.size() && serials[order[k]] / lattice.size() == piece; ++k)
            particleOf[serials[order[k]] % lattice.size()] = order[k];
        addSide({2, last.z, 0, 1}, lattice, particleOf);
        if (last.z == 0) continue;
        addSide({2, 0, 1, 0}, lattice, particleOf);
        addSide({1, 0, 0, 2}, lattice, particleOf);
        addSide({1, last.y, 2, 0}, lattice, particleOf);
        addSide({0, 0, 2, 1}, lattice, particleOf);
        addSide({0, last.x, 1, 2}, lattice, particleOf);
    }
    return true;
}

std::size_t LatticeSurface::bytes() const {
    return serials_.capacity() * sizeof(std::uint64_t) + vertices_.capacity() * sizeof(Vertex) +
           triangles_.capacity() * sizeof(std::uint32_t);
}

}  // namespace dustbench::particles
