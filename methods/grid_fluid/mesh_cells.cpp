#include "methods/grid_fluid/mesh_cells.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <tuple>

namespace dustbench::grid_fluid {
namespace {

/// Returns the side of the line from `a` to `b` on which a point of the y-z plane lies. Two triangles at an edge must
/// agree to the last bit in either orientation, so the edge is always evaluated from its lesser end.
bool isLeftOf(const glm::dvec2& a, const glm::dvec2& b, const glm::dvec2& point) {
    const bool turned = std::tie(b.x, b.y) < std::tie(a.x, a.y);
    const glm::dvec2 &from = turned ? b : a, &to = turned ? a : b;
    const double area = (to.x - from.x) * (point.y - from.y) - (to.y - from.y) * (point.x - from.x);
    return (area >= 0) != turned;
}

}  // namespace

MeshCells::MeshCells(glm::ivec3 cells, MemoryAccount& account, flow_gl::CellsOnRays* gpu)
    : cells_(cells), gpu_(gpu), bodies_(account), velocities_(account) {
    bodies_.resize(static_cast<std::size_t>(cells.x) * static_cast<std::size_t>(cells.y) *
                   static_cast<std::size_t>(cells.z));
}

void MeshCells::clear() {
    std::ranges::fill(bodies_, std::uint8_t{0});
    areOnGpu_ = false;
}

void MeshCells::finish() {
    if (areOnGpu_) gpu_->read(bodies_);
    areOnGpu_ = false;
}

MeshCells::Sweep MeshCells::sweepAlong(int axis) const {
    const glm::ivec3 strides(1, cells_.x, cells_.x * cells_.y);
    const auto turned = [&](const glm::ivec3& each) {
        return glm::ivec3(each[axis], each[(axis + 1) % 3], each[(axis + 2) % 3]);
    };
    return {turned(cells_), turned(strides)};
}

template <typename Take>
void MeshCells::cross(const Sweep& sweep, const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c,
                      const Take& take) {
    const glm::dvec3 minimum = glm::min(glm::min(a, b), c), maximum = glm::max(glm::max(a, b), c);
    const glm::dvec3 size(sweep.cells);
    // Triangles next to the box do not cross any row; those in front of it or behind it still count.
    if (maximum.y < 0 || maximum.z < 0 || minimum.y > size.y || minimum.z > size.z) return;
    const auto firstOf = [](double value) { return std::max(0, static_cast<int>(std::ceil(value - 0.5))); };
    const int firstJ = firstOf(minimum.y), firstK = firstOf(minimum.z);
    const int lastJ = static_cast<int>(std::min(size.y - 1, std::floor(maximum.y - 0.5)));
    const int lastK = static_cast<int>(std::min(size.z - 1, std::floor(maximum.z - 0.5)));
    if (firstJ > lastJ || firstK > lastK) return;
    const glm::dvec3 normal = glm::cross(b - a, c - a);
    if (!(std::abs(normal.x) > 0)) return;
    const bool leaving = normal.x > 0;
    const glm::vec3 unit(glm::normalize(normal));
    const glm::dvec2 pa(a.y, a.z), pb(b.y, b.z), pc(c.y, c.z);
    for (int k = firstK; k <= lastK; ++k)
        for (int j = firstJ; j <= lastJ; ++j) {
            const glm::dvec2 point(j + 0.5, k + 0.5);
            // Seen along x, a surface that the ray leaves is counter-clockwise.
            const bool left = isLeftOf(pa, pb, point);
            if (left != leaving || isLeftOf(pb, pc, point) != leaving || isLeftOf(pc, pa, point) != leaving) continue;
            const double x = a.x - (normal.y * (point.x - a.y) + normal.z * (point.y - a.z)) / normal.x;
            const int row = j * sweep.strides.y + k * sweep.strides.z;
            crossings_.push_back({static_cast<std::uint32_t>(row), static_cast<float>(x), leaving ? -1 : 1, unit,
                                  static_cast<std::uint32_t>(crossings_.size())});
            take(glm::dvec3(x, point.x, point.y), normal);
        }
}

void MeshCells::add(const scene::Mesh& mesh, const glm::dmat4& toCells, std::uint8_t body,
                    std::span<const glm::vec3> velocities) {
    places_.clear();
    glm::dvec3 minimum(INFINITY), maximum(-INFINITY);
    for (const glm::vec3& position : mesh.positions) {
        places_.emplace_back(toCells * glm::dvec4(position, 1));
        minimum = glm::min(minimum, places_.back());
        maximum = glm::max(maximum, places_.back());
    }
    if (glm::any(glm::lessThan(maximum, glm::dvec3(0))) || glm::any(glm::greaterThan(minimum, glm::dvec3(cells_))))
        return;
    const auto alongEachAxis = [&](const auto& take) {
        for (int axis = 0; axis < 3; ++axis) {
            take(axis);
            for (glm::dvec3& place : places_) place = {place.y, place.z, place.x};
        }
    };
    if (gpu_) {
        if (!areOnGpu_) gpu_->begin(bodies_);
        areOnGpu_ = true;
        gpu_->add(places_, mesh.indices, body);
    } else {
        alongEachAxis([&](int axis) { sweep(mesh.indices, axis, body); });
    }
    if (velocities.empty()) return;
    finish();
    // Only after all cells are known: the rays along one axis may find a wall whose speed comes from another axis.
    velocities_.resize(bodies_.size());
    known_.assign(bodies_.size(), 0);
    alongEachAxis([&](int axis) {
        const Sweep along = sweepAlong(axis);
        findCrossings(along, mesh.indices, velocities);
        forEachRow([&](std::span<const Crossing> row) { setVelocities(along, axis, row, body); });
    });
}

/// Sorts the crossings by rows; `velocities`: those of the vertices, or none.
void MeshCells::findCrossings(const Sweep& along, std::span<const std::uint32_t> indices,
                              std::span<const glm::vec3> velocities) {
    crossings_.clear();
    crossingVelocities_.clear();
    for (std::size_t t = 0; t + 2 < indices.size(); t += 3) {
        const glm::dvec3 &a = places_[indices[t]], &b = places_[indices[t + 1]], &c = places_[indices[t + 2]];
        if (velocities.empty()) {
            cross(along, a, b, c, [](const glm::dvec3&, const glm::dvec3&) {});
            continue;
        }
        cross(along, a, b, c, [&](const glm::dvec3& place, const glm::dvec3& normal) {
            // Barycentric weights: the areas opposite the corners, as shares of the triangle.
            const double whole = glm::dot(normal, normal);
            const double ofA = glm::dot(glm::cross(c - b, place - b), normal) / whole;
            const double ofB = glm::dot(glm::cross(a - c, place - c), normal) / whole;
            crossingVelocities_.emplace_back(ofA * glm::dvec3(velocities[indices[t]]) +
                                             ofB * glm::dvec3(velocities[indices[t + 1]]) +
                                             (1 - ofA - ofB) * glm::dvec3(velocities[indices[t + 2]]));
        });
    }
    std::ranges::sort(crossings_, [](const Crossing& a, const Crossing& b) {
        return std::tie(a.row, a.x, a.inwards, a.number) < std::tie(b.row, b.x, b.inwards, b.number);
    });
}

template <typename Take>
void MeshCells::forEachRow(const Take& take) const {
    for (std::size_t first = 0; first < crossings_.size();) {
        std::size_t end = first;
        while (end < crossings_.size() && crossings_[end].row == crossings_[first].row) ++end;
        take(std::span<const Crossing>(crossings_.data() + first, end - first));
        first = end;
    }
}

void MeshCells::sweep(std::span<const std::uint32_t> indices, int axis, std::uint8_t body) {
    const Sweep along = sweepAlong(axis);
    findCrossings(along, indices, {});
    forEachRow([&](std::span<const Crossing> row) {
        if (axis == 0) fillRow(row, body);
        fillThinWalls(along, row, body);
    });
}

/// Along the rays, a cell takes the speed of the surface; across them, only if no other ray provides it.
void MeshCells::setVelocities(const Sweep& along, int axis, std::span<const Crossing> crossings, std::uint8_t body) {
    const auto limit = [&](float x) {
        return static_cast<int>(std::clamp(x, 0.0f, static_cast<float>(along.cells.x)));
    };
    const int first = limit(std::floor(crossings.front().x) - 1), end = limit(std::ceil(crossings.back().x) + 1);
    for (int i = first; i < end; ++i) {
        const std::size_t at =
            crossings[0].row + static_cast<std::size_t>(i) * static_cast<std::size_t>(along.strides.x);
        if (bodies_[at] != body) continue;
        const glm::vec3 velocity = velocityAt(static_cast<float>(i) + 0.5f, crossings);
        for (int each = 0; each < 3; ++each)
            if (each == axis || (known_[at] >> each & 1) == 0) velocities_[at][each] = velocity[each];
        known_[at] = static_cast<std::uint8_t>(known_[at] | 1u << axis);
    }
}

/// Velocity at a cell's centre: that of the surface between it and its neighbour, the mean if there is one on either
/// side, or interpolated between two more distant ones.
glm::vec3 MeshCells::velocityAt(float x, std::span<const Crossing> crossings) const {
    const auto right = std::ranges::lower_bound(crossings, x, {}, &Crossing::x);
    const auto of = [&](auto crossing) { return crossingVelocities_[crossing->number]; };
    if (right == crossings.begin()) return of(right);
    const auto left = right - 1;
    if (right == crossings.end()) return of(left);
    const float toLeft = x - left->x, toRight = right->x - x;
    if (toLeft <= 1 && toRight <= 1) return 0.5f * (of(left) + of(right));
    if (toLeft <= 1) return of(left);
    if (toRight <= 1) return of(right);
    return (toRight * of(left) + toLeft * of(right)) / (toLeft + toRight);
}

void MeshCells::fillThinWalls(const Sweep& sweep, std::span<const Crossing> crossings, std::uint8_t body) {
    constexpr float opposed = -0.5f;  // the cosine of 120 degrees
    for (std::size_t n = 1; n < crossings.size(); ++n) {
        const Crossing &entered = crossings[n - 1], &left = crossings[n];
        if (entered.inwards != 1 || left.inwards != -1 || glm::dot(entered.normal, left.normal) > opposed) continue;
        if (left.x - entered.x >= 1) continue;  // a centre is in it; shorter intervals take the cell of their middle
        const int i = static_cast<int>(std::floor(0.5f * (entered.x + left.x)));
        if (i >= 0 && i < sweep.cells.x)
            bodies_[entered.row + static_cast<std::size_t>(i) * static_cast<std::size_t>(sweep.strides.x)] = body;
    }
}

void MeshCells::fillRow(std::span<const Crossing> crossings, std::uint8_t body) {
    // depths_[n]: how often the ray is inside between crossings n and n + 1, counted from the left.
    depths_.clear();
    int depth = 0;
    for (const Crossing& crossing : crossings) depths_.push_back(depth = std::max(0, depth + crossing.inwards));
    depth = 0;
    std::uint8_t* row = bodies_.data() + crossings[0].row;
    const auto firstBeyond = [&](float x) {
        return static_cast<int>(std::clamp(std::ceil(x - 0.5f), 0.0f, static_cast<float>(cells_.x)));
    };
    for (std::size_t n = crossings.size() - 1; n > 0; --n) {
        depth = std::max(0, depth - crossings[n].inwards);
        if (depth == 0 || depths_[n - 1] == 0) continue;
        const int first = firstBeyond(crossings[n - 1].x), end = firstBeyond(crossings[n].x);
        if (end > first) std::memset(row + first, body, static_cast<std::size_t>(end - first));
    }
}

}  // namespace dustbench::grid_fluid
