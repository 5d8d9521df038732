// The three rules of a flock, for all boids at once: neighbours within `sight` by a uniform grid, in linear time.
//
//     a_i = s·Σ_near (x_i − x_j)/d²  +  m·(mean v_j − v_i)  +  c·(mean x_j − x_i)
//           separation, d < near        matching, d < sight     cohesion, d < sight
//
// The grid orders points by cells, cubes with an edge of the reach, or of half of it where points are dense, or more.
// Cells next to each other along x are contiguous, so that the neighbours of a point are in one run of points for each
// row of cells that a ball of this radius meets: at most 9, or 25 of the small ones. Within a cell, points keep the
// order in which they were given. Boids are copied in the order of the cells, a column for each coordinate, so that
// neighbours are contiguous: 16 at a time, whatever the machine's registers, so that every build gives the same sums.
//
// Units: m, m/s, m/s². Owns: grid and columns. Threads: one, with the current oneTBB arena; const members of the grid
// by any. Every boid sums its neighbours in the order of the grid, so that results are the same for any number of
// threads. Source: Reynolds1987, 3; Green2010, 3 (counting sort into cells). Departs: boids see in all directions; the
// rules' accelerations are added, not taken by priority.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

namespace dustbench::particles {

/// A uniform grid over points, for neighbours within a distance.
class PointGrid {
 public:
    /// Points `first` to `end` in the order of the cells.
    struct Run {
        std::uint32_t first, end;
        float away2;  ///< they are at least this far away: m², across the run
    };

    /// Replaces the points. If they are spread so far that cells would outnumber them by far, cells are larger.
    void build(std::span<const float> x, std::span<const float> y, std::span<const float> z, float reachMetres);

    [[nodiscard]] std::size_t size() const { return order_.size(); }
    /// Index of each point as given, in the order of the cells.
    [[nodiscard]] std::span<const std::uint32_t> order() const { return order_; }
    /// Calls `action(run)` for runs that hold all points within the reach of `point`, and others, each point once.
    template <typename Action>
    void forEachRun(const glm::vec3& point, const Action& action) const;
    [[nodiscard]] std::size_t bytes() const;

 private:
    void chooseCells(std::span<const float> x, std::span<const float> y, std::span<const float> z, float reachMetres);
    /// Number of the cell along an axis; points that are not finite are in the first.
    [[nodiscard]] int cellAlong(float coordinate, int axis) const {
        const float at = (coordinate - minimum_[axis]) * perEdge_;
        return at > 0 ? static_cast<int>(std::min(at, static_cast<float>(cells_[axis] - 1))) : 0;
    }
    /// Distance of a coordinate from a cell along an axis, less the slack.
    [[nodiscard]] float away(float coordinate, int cell, int axis) const {
        const float at = (coordinate - minimum_[axis]) * perEdge_;
        const float cells = std::max(static_cast<float>(cell) - at, at - static_cast<float>(cell + 1));
        return cells > slack_ ? (cells - slack_) / perEdge_ : 0;
    }

    glm::vec3 minimum_{0};
    float perEdge_ = 1;  ///< 1/edge
    float reach_ = 0;
    float slack_ = 0;  ///< in cells: bound on the rounding error of a coordinate in cells
    glm::ivec3 cells_{1};
    std::vector<std::uint32_t> cellOfPoint_, order_;
    std::vector<std::uint32_t> begin_;  ///< of each cell in `order_`, and the end
};

template <typename Action>
void PointGrid::forEachRun(const glm::vec3& point, const Action& action) const {
    const float reach2 = reach_ * reach_;
    const int endLayer = cellAlong(point.z + reach_, 2) + 1, endRow = cellAlong(point.y + reach_, 1) + 1;
    for (int layer = cellAlong(point.z - reach_, 2); layer < endLayer; ++layer) {
        const float upwards = away(point.z, layer, 2);
        for (int row = cellAlong(point.y - reach_, 1); row < endRow; ++row) {
            const float sideways = away(point.y, row, 1);
            const float left2 = reach2 - upwards * upwards - sideways * sideways;
            if (left2 < 0) continue;
            const float half = std::sqrt(left2);
            const int line = cells_.x * (row + cells_.y * layer);
            const Run run{begin_[static_cast<std::size_t>(line + cellAlong(point.x - half, 0))],
                          begin_[static_cast<std::size_t>(line + cellAlong(point.x + half, 0)) + 1],
                          upwards * upwards + sideways * sideways};
            if (run.first < run.end) action(run);
        }
    }
}

struct FlockRules {
    float nearMetres = 0.3f;   ///< boids closer than this separate; at most the sight
    float sightMetres = 0.6f;  ///< other boids within this count
    float separation = 1;      ///< m²/s²
    float matching = 1;        ///< 1/s
    float cohesion = 1;        ///< 1/s²
};

struct FlockState {
    std::span<const float> x, y, z, velocityX, velocityY, velocityZ;
};

/// What a boid sums over its neighbours.
struct FlockSums {
    glm::vec3 apart{0}, offset{0}, velocity{0};
    float seen = 0;

    /// Adds a neighbour at x_j − x_i = `to`, whose velocity relative to the boid's is `relative`.
    void add(const glm::vec3& to, const glm::vec3& relative, float squared, const FlockRules& rules) {
        if (squared < rules.nearMetres * rules.nearMetres) apart -= to * (1 / squared);
        offset += to;
        velocity += relative;
        seen += 1;
    }
    [[nodiscard]] glm::vec3 acceleration(const FlockRules& rules) const {
        if (seen == 0) return glm::vec3(0);
        return rules.separation * apart + (rules.matching * velocity + rules.cohesion * offset) * (1 / seen);
    }
};

class Flock {
 public:
    /// Writes the acceleration of every boid.
    void accelerate(const FlockRules& rules, const FlockState& state, std::span<glm::vec3> accelerations);

    [[nodiscard]] std::size_t bytes() const { return grid_.bytes() + 6 * columns_[0].capacity() * sizeof(float); }

 private:
    PointGrid grid_;
    std::array<std::vector<float>, 6> columns_;  ///< x y z and velocity, in the order of the grid, then 16 more
};

/// The same, one neighbour at a time, in the order of the grid: a reference for tests with many boids.
void accelerateOneByOne(const FlockRules& rules, const FlockState& state, std::span<glm::vec3> accelerations);
/// The same by all pairs: the reference for tests.
void accelerateByAllPairs(const FlockRules& rules, const FlockState& state, std::span<glm::vec3> accelerations);

}  // namespace dustbench::particles
