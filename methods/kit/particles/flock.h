// The three rules of a flock, for all boids at once: neighbours within `sight` by a uniform grid, in linear time.
//
//     a_i = s·Σ_near (x_i − x_j)/d²  +  m·(mean v_j − v_i)  +  c·(mean x_j − x_i)
//           separation, d < near        matching, d < sight     cohesion, d < sight
//
// Units: m, m/s, m/s². Owns: its grid. Threads: spreads boids over the current oneTBB arena; every boid sums its
// neighbours in the order of the grid, so that results are the same for any number of threads.
// Source: Reynolds1987, 3. Departs: boids see in all directions; the rules' accelerations are added, not taken by
// priority.
#pragma once

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

    [[nodiscard]] std::size_t bytes() const { return grid_.bytes() + boids_.capacity() * sizeof(Boid); }

 private:
    struct Boid {
        glm::vec3 position, velocity;
    };

    PointGrid grid_;
    std::vector<Boid> boids_;  ///< in the order of the grid
};

/// The same by all pairs: the reference for tests.
void accelerateByAllPairs(const FlockRules& rules, const FlockState& state, std::span<glm::vec3> accelerations);

}  // namespace dustbench::particles
