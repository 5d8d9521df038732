// How far a particle is from its parabola after one second under both laws of motion (particles/relief_particles.h).
//
// The paper prints P = P₀ + V₀·T + ½·g·T² and V = V₀·T + g·T, with T the age in steps, and rewrites P₀ and V₀ in each
// step. A thousand particles with random velocities of up to 1 m/s along each axis fall for one second under 9.8 m/s²,
// in 1, 4, 8 or 12 steps (after 34 the paper's velocities exceed floats), and in 60 steps of the corrected law.
//
// Findings, medians over the particles in m; intervals are over seven seeds:
//     distance_paper_STEPS       from the exact parabola, as printed
//     distance_fixed_STEPS       with V₀ + g·Δt, and T as the time step
//     distance_first_order_60    with P₀ + V₀·Δt, a control: it falls short by ½·g·Δt
//     distance_without_gravity   of a straight line, a control: ½·g
//
// Threads: one. Source: Bergeron, 3.2.
#include <fmt/format.h>

#include <algorithm>

#include "methods/contract/experiment.h"
#include "methods/kit/findings/findings.h"
#include "methods/kit/maths/philox.h"
#include "methods/relief/particles/relief_particles.h"

namespace dustbench::relief::motion {
namespace {

constexpr glm::vec3 gravity{0, -9.8f, 0};
constexpr int particles = 1000;
constexpr std::uint64_t seeds = 7;

/// One step of a law: the particle, its age in steps including this one, and the step in s.
using Law = Motion (*)(const Motion&, float, float);

Motion paper(const Motion& old, float ageSteps, float dt) {
    return moved(MotionLaw::paper, old, gravity, ageSteps, dt);
}
Motion fixed(const Motion& old, float ageSteps, float dt) {
    return moved(MotionLaw::fixed, old, gravity, ageSteps, dt);
}
Motion weightless(const Motion& old, float ageSteps, float dt) {
    return moved(MotionLaw::fixed, old, glm::vec3(0), ageSteps, dt);
}
Motion firstOrder(const Motion& old, float, float dt) {
    return {old.place + old.velocity * dt, old.velocity + gravity * dt};
}

double distanceAfterOneSecond(Law law, const glm::vec3& velocity, int steps) {
    Motion particle{glm::vec3(0), velocity};
    for (int step = 1; step <= steps; ++step)
        particle = law(particle, static_cast<float>(step), 1.0f / static_cast<float>(steps));
    return glm::distance(glm::dvec3(particle.place), glm::dvec3(velocity) + 0.5 * glm::dvec3(gravity));
}

double medianDistance(Law law, int steps, std::uint64_t seed) {
    std::vector<double> distances;
    distances.reserve(particles);
    for (std::uint64_t n = 0; n < particles; ++n) {
        const auto random = maths::uniform4(seed, 4, n);
        const glm::vec3 velocity(maths::centred(random[0]), maths::centred(random[1]), maths::centred(random[2]));
        distances.push_back(distanceAfterOneSecond(law, velocity, steps));
    }
    std::ranges::nth_element(distances, distances.begin() + particles / 2);
    return distances[particles / 2];
}

Finding distanceOf(std::string quantity, Law law, int steps, std::uint64_t seed) {
    std::vector<double> medians;
    for (std::uint64_t k = 0; k < seeds; ++k) medians.push_back(medianDistance(law, steps, seed + k));
    return findings::meanOf(std::move(quantity), medians);
}

std::vector<Finding> measured(ExperimentContext& context) {
    std::vector<Finding> findings;
    for (const int steps : {1, 4, 8, 12})
        findings.push_back(distanceOf(fmt::format("distance_paper_{}", steps), paper, steps, context.seed()));
    for (const int steps : {1, 4, 8, 12, 60})
        findings.push_back(distanceOf(fmt::format("distance_fixed_{}", steps), fixed, steps, context.seed()));
    findings.push_back(distanceOf("distance_first_order_60", firstOrder, 60, context.seed()));
    findings.push_back(distanceOf("distance_without_gravity", weightless, 60, context.seed()));
    return findings;
}

}  // namespace

ExperimentInfo describe() {
    ExperimentInfo info;
    info.summary = "Measures how far a particle is from its parabola after one second, under both laws of motion.";
    info.source = "Bergeron";
    info.run = measured;
    return info;
}

}  // namespace dustbench::relief::motion
