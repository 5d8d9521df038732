#include "methods/kit/particles/lattice_links.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

namespace dustbench::particles {
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

}  // namespace dustbench::particles
