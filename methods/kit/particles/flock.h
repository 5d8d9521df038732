// The three rules of a flock, for all boids at once: neighbours within `sight` by a uniform grid, in linear time.
//
//     a_i = s·Σ_near (x_i − x_j)/d²  +  m·(mean v_j − v_i)  +  c·(mean x_j − x_i)
//           separation, d < near        matching, d < sight     cohesion, d < sight
//
// Boids are copied in the order of the grid's cells, a column for each coordinate, so that neighbours are contiguous:
// 16 at a time, whatever the machine's registers, so that every build gives the same sums. Units: m, m/s, m/s². Owns:
// its grid and columns. Threads: spreads boids over the current oneTBB arena; every boid sums its neighbours in the
// order of the grid, so that results are the same for any number of threads. Source: Reynolds1987, 3. Departs: boids
// see in all directions; the rules' accelerations are added, not taken by priority.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "methods/kit/particles/point_grid.h"

namespace dustbench::particles {

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
