#include "methods/kit/particles/lattice.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <string>

#include "methods/contract/choices.h"
#include "methods/contract/errors.h"
#include "methods/kit/particles/part_parameters.h"

namespace dustbench::particles {
namespace {

constexpr Choices<bool> latticeFrames{{"world", false}, {"vehicle", true}};

glm::dvec3 stepOf(const ParameterValues& values, const std::string& name, int points) {
    const glm::dvec3 step = vectorOf(values, name, spaceAxes);
    if (points > 1 && !(glm::length(step) >= 1e-4))
        throw InputError("parameter " + name + ": got a length of " + std::to_string(glm::length(step)) +
                         " m, allowed: at least 0.0001 m");
    return step;
}

}  // namespace

void Lattice::declare(ParameterSet& set) {
    set.integer("columns", 20, 1, 4096, "", "points along the first axis")
        .integer("rows", 20, 1, 4096, "", "points along the second axis")
        .integer("layers", 1, 1, 256, "", "points along the third axis; 1: a surface")
        .choice("frame", false, latticeFrames, "the frame of all positions: the world's or the vehicle's");
    declareVector(set, "place", spaceAxes, {0, 2, 0}, -1e6, 1e6, "m", "position of the first point");
    declareVector(set, "column_step", spaceAxes, {0.05, 0, 0}, -1e3, 1e3, "m", "from a column to the next");
    declareVector(set, "row_step", spaceAxes, {0, -0.05, 0}, -1e3, 1e3, "m", "from a row to the next");
    declareVector(set, "layer_step", spaceAxes, {0, 0, 0.05}, -1e3, 1e3, "m", "from a layer to the next");
    declareVector(set, "piece_step", spaceAxes, {0, 0, 0.5}, -1e6, 1e6, "m",
                  "from a piece to the next: particles beyond columns × rows × layers form further pieces");
}

Lattice Lattice::from(const ParameterValues& values) {
    Lattice lattice;
    lattice.points = {static_cast<int>(values.integer("columns")), static_cast<int>(values.integer("rows")),
                      static_cast<int>(values.integer("layers"))};
    lattice.place = vectorOf(values, "place", spaceAxes);
    lattice.column = stepOf(values, "column_step", lattice.points.x);
    lattice.row = stepOf(values, "row_step", lattice.points.y);
    lattice.layer = stepOf(values, "layer_step", lattice.points.z);
    lattice.piece = vectorOf(values, "piece_step", spaceAxes);
    lattice.onVehicle = values.choice("frame", latticeFrames);
    constexpr std::uint64_t maximum = 1 << 28;
    if (lattice.size() > maximum)
        throw InputError("parameter columns: got " + std::to_string(lattice.size()) +
                         " points (columns × rows × layers), allowed: at most " + std::to_string(maximum));
    return lattice;
}

namespace {

constexpr std::array<glm::ivec3, 3> edgeOffsets{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
constexpr std::array<glm::ivec3, 6> diagonalOffsets{
    {{1, 1, 0}, {1, -1, 0}, {1, 0, 1}, {1, 0, -1}, {0, 1, 1}, {0, 1, -1}}};

/// Links along an offset form rows; every second one has the other colour.
int colourAlong(const glm::ivec3& offset, const glm::ivec3& node) {
    for (int axis = 0; axis < 3; ++axis)
        if (offset[axis] != 0) return node[axis] / std::abs(offset[axis]) % 2;
    return 0;
}

}  // namespace

bool isPinned(Pins pins, const Lattice& lattice, const glm::ivec3& node) {
    switch (pins) {
        case Pins::none:
            return false;
        case Pins::corners:
            return node.y == 0 && node.z == 0 && (node.x == 0 || node.x == lattice.points.x - 1);
        case Pins::row:
            return node.y == 0;
        case Pins::column:
            return node.x == 0;
        case Pins::end:
            return node == glm::ivec3(0);
    }
    return false;
}

void LatticeLinks::follow(const Lattice& lattice, Pins pins, const LinkShares& shares,
                          std::span<const std::uint64_t> serials) {
    if (std::ranges::equal(serials, serials_)) return;
    serials_.assign(serials.begin(), serials.end());
    order_.resize(serials.size());
    std::iota(order_.begin(), order_.end(), 0u);
    std::ranges::sort(order_, {}, [&](std::uint32_t i) { return serials_[i]; });
    linkAll(lattice, shares);
    pinned_.clear();
    for (const std::uint32_t i : order_)
        if (isPinned(pins, lattice, lattice.nodeOf(serials_[i]))) pinned_.push_back(i);
    bound(serials.size());
}

void LatticeLinks::linkAll(const Lattice& lattice, const LinkShares& shares) {
    links_.clear();
    colourBegin_.assign(1, 0);
    for (const glm::ivec3& offset : edgeOffsets) linkAlong(lattice, offset, 1);
    if (shares.diagonals > 0)
        for (const glm::ivec3& offset : diagonalOffsets) linkAlong(lattice, offset, shares.diagonals);
    if (shares.bending > 0)
        for (const glm::ivec3& offset : edgeOffsets) linkAlong(lattice, 2 * offset, shares.bending);
}

void LatticeLinks::linkAlong(const Lattice& lattice, const glm::ivec3& offset, float share) {
    const glm::dvec3 n(offset);
    const auto rest = static_cast<float>(glm::length(n.x * lattice.column + n.y * lattice.row + n.z * lattice.layer));
    const std::int64_t ahead = offset.x + lattice.points.x * (offset.y + std::int64_t{lattice.points.y} * offset.z);
    for (int colour = 0; colour < 2; ++colour) {
        for (const std::uint32_t i : order_) {
            const glm::ivec3 node = lattice.nodeOf(serials_[i]), other = node + offset;
            if (glm::any(glm::lessThan(other, glm::ivec3(0))) ||
                glm::any(glm::greaterThanEqual(other, lattice.points)) || colourAlong(offset, node) != colour)
                continue;
            const std::uint64_t wanted = serials_[i] + static_cast<std::uint64_t>(ahead);
            const auto found =
                std::ranges::lower_bound(order_, wanted, {}, [&](std::uint32_t k) { return serials_[k]; });
            if (found != order_.end() && serials_[*found] == wanted) links_.push_back({i, *found, rest, share});
        }
        if (links_.size() > colourBegin_.back()) colourBegin_.push_back(links_.size());
    }
}

void LatticeLinks::bound(std::size_t particles) {
    std::vector<std::uint8_t> fixed(particles, 0);
    for (const std::uint32_t i : pinned_) fixed[i] = 1;
    std::vector<double> row(particles, 0);
    for (const Link& link : links_) {
        const auto share = static_cast<double>(link.share);
        row[link.a] += fixed[link.b] ? share : 2 * share;
        row[link.b] += fixed[link.a] ? share : 2 * share;
    }
    eigenvalueBound_ = 0;
    for (std::size_t i = 0; i < particles; ++i)
        if (!fixed[i]) eigenvalueBound_ = std::max(eigenvalueBound_, row[i]);
}

std::size_t LatticeLinks::bytes() const {
    return serials_.capacity() * sizeof(std::uint64_t) + links_.capacity() * sizeof(Link) +
           (order_.capacity() + pinned_.capacity()) * sizeof(std::uint32_t) +
           colourBegin_.capacity() * sizeof(std::size_t);
}

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
