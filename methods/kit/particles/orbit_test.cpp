// Tests that particles born on circular orbits stay on them.
#include <gtest/gtest.h>

#include <cmath>

#include "methods/kit/particles/test_world.h"

namespace dustbench::particles {
namespace {

constexpr double orbitStepSeconds = 1.0 / 240;

ParticleSystem disc(const std::string& law, const std::string& more = "", const std::string& velocity = "") {
    const std::string pull = "law = \"" + law + "\", strength = 5, softening_metres = 0.1";
    return test::systemFrom(
        R"(
emission = { part = "bursts", count = 300, duration_seconds = 0, interval_seconds = 1e6 }
position = { part = "disc", at = "place", place = [1, 20, -2], radius_metres = 3, normal = [0.6, 0, 0.8] }
velocity = { part = "orbit", axis = [0.6, 0, 0.8], )" +
        pull + velocity + R"( }
colour = { part = "constant" }
size = { part = "constant" }
life = [ { part = "lifetime", average_seconds = 1e5, variation_seconds = 0 } ]
force = [ { part = "attractor", place = [1, 20, -2], )" +
        pull + " }" + more + " ]\n");
}

struct Orbit {
    double distance, offPlane, angularMomentum;
};

std::vector<Orbit> orbitsOf(const ParticleStore& s) {
    const glm::dvec3 axis(0.6, 0, 0.8);
    std::vector<Orbit> list;
    for (std::size_t i = 0; i < s.size(); ++i) {
        const glm::dvec3 from = glm::dvec3(s.position(i)) - glm::dvec3(1, 20, -2);
        const glm::dvec3 v(s.velocityX[i], s.velocityY[i], s.velocityZ[i]);
        list.push_back({glm::length(from), glm::dot(from, axis), glm::dot(glm::cross(from, v), axis)});
    }
    return list;
}

void advance(ParticleSystem& system, int steps) {
    const scene::Scene scene;
    const scene::SceneState state;
    for (int i = 0; i < steps; ++i) system.update({scene, state, orbitStepSeconds});
}

TEST(OrbitVelocity, KeepsCirclesOfEveryLawAsTheyAre) {
    for (const std::string law : {"1/d2", "1/d", "1/sqrt_d"}) {
        auto system = disc(law);
        advance(system, 1);
        const auto before = orbitsOf(system.store());
        ASSERT_EQ(before.size(), 300u);
        std::vector<double> nearest(300, INFINITY), farthest(300, 0);
        for (int i = 0; i < 240 * 8; ++i) {
            advance(system, 1);
            const auto now = orbitsOf(system.store());
            for (std::size_t k = 0; k < now.size(); ++k) {
                nearest[k] = std::min(nearest[k], now[k].distance);
                farthest[k] = std::max(farthest[k], now[k].distance);
                ASSERT_NEAR(now[k].offPlane, 0, 1e-3) << law;
            }
        }
        int compared = 0;
        for (std::size_t k = 0; k < before.size(); ++k) {
            // A particle starts half a step behind its velocity: the orbit's radius swings by ω·Δt, ω = v/d.
            const double d = before[k].distance, turn = before[k].angularMomentum / (d * d) * orbitStepSeconds;
            ASSERT_GT(turn, 0) << law;
            if (d < 0.5) continue;
            EXPECT_LT(farthest[k] / nearest[k] - 1, 2.5 * turn + 1e-4) << law << " at " << d;
            ++compared;
        }
        EXPECT_GT(compared, 250);
    }
}

TEST(OrbitVelocity, IsThatOfKepler) {
    // Far beyond the softening v²·d = k.
    auto system = disc("1/d2");
    advance(system, 1);
    for (const Orbit& orbit : orbitsOf(system.store()))
        if (orbit.distance > 2) {
            EXPECT_NEAR(std::pow(orbit.angularMomentum, 2) / orbit.distance, 5, 5 * 0.01) << orbit.distance;
        }
}

TEST(OrbitVelocity, SlowerOnesFallIn) {
    // The control: at three quarters of the speed no orbit stays a circle.
    auto system = disc("1/d2", "", ", speed = -0.3");
    advance(system, 1);
    const auto before = orbitsOf(system.store());
    std::vector<double> nearest(300, INFINITY);
    for (int i = 0; i < 240 * 8; ++i) {
        advance(system, 1);
        const auto now = orbitsOf(system.store());
        for (std::size_t k = 0; k < now.size(); ++k) nearest[k] = std::min(nearest[k], now[k].distance);
    }
    for (std::size_t k = 0; k < before.size(); ++k)
        if (before[k].distance > 1 && before[k].distance < 2.5) {
            EXPECT_LT(nearest[k], 0.9 * before[k].distance) << before[k].distance;
        }
}

}  // namespace
}  // namespace dustbench::particles
