#include "methods/kit/particles/flock.h"

#include "methods/kit/parallel/for_each_block.h"

namespace dustbench::particles {
namespace {

constexpr std::size_t flockBlock = 512;

}  // namespace

void Flock::accelerate(const FlockRules& rules, const FlockState& s, std::span<glm::vec3> accelerations) {
    const float reach2 = rules.sightMetres * rules.sightMetres;
    grid_.build(s.x, s.y, s.z, rules.sightMetres);
    boids_.resize(s.x.size());
    parallel::forEachBlock(boids_.size(), 8192, [&](std::size_t first, std::size_t count) {
        for (std::size_t place = first; place < first + count; ++place) {
            const std::uint32_t i = grid_.order()[place];
            boids_[place] = {{s.x[i], s.y[i], s.z[i]}, {s.velocityX[i], s.velocityY[i], s.velocityZ[i]}};
        }
    });
    parallel::forEachBlock(boids_.size(), flockBlock, [&](std::size_t first, std::size_t count) {
        std::uint32_t cell = 0xffffffff;
        std::array<PointGrid::Run, 9> runs{};
        for (std::size_t place = first; place < first + count; ++place) {
            if (grid_.cellOf(place) != cell) runs = grid_.around(cell = grid_.cellOf(place));
            const Boid self = boids_[place];
            FlockSums sums;
            for (const PointGrid::Run& run : runs)
                for (std::uint32_t j = run.first; j < run.end; ++j) {
                    const glm::vec3 to = boids_[j].position - self.position;
                    const float squared = glm::dot(to, to);
                    if (squared < reach2 && squared > 0)
                        sums.add(to, boids_[j].velocity - self.velocity, squared, rules);
                }
            accelerations[grid_.order()[place]] = sums.acceleration(rules);
        }
    });
}

void accelerateByAllPairs(const FlockRules& rules, const FlockState& s, std::span<glm::vec3> accelerations) {
    const std::size_t count = s.x.size();
    const float reach2 = rules.sightMetres * rules.sightMetres;
    for (std::size_t i = 0; i < count; ++i) {
        FlockSums sums;
        for (std::size_t j = 0; j < count; ++j) {
            const glm::vec3 to(s.x[j] - s.x[i], s.y[j] - s.y[i], s.z[j] - s.z[i]);
            const float squared = glm::dot(to, to);
            if (squared < reach2 && squared > 0)
                sums.add(
                    to,
                    {s.velocityX[j] - s.velocityX[i], s.velocityY[j] - s.velocityY[i], s.velocityZ[j] - s.velocityZ[i]},
                    squared, rules);
        }
        accelerations[i] = sums.acceleration(rules);
    }
}

}  // namespace dustbench::particles
