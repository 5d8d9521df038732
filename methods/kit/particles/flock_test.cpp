// Tests the flock: its grid against all pairs, conserved momentum, the order parameter, obstacles.
#include <gtest/gtest.h>
#include <tbb/global_control.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <set>

#include "methods/kit/maths/philox.h"
#include "methods/kit/maths/sampling.h"
#include "methods/kit/particles/flock.h"
#include "methods/kit/particles/test_world.h"

namespace dustbench::particles {
namespace {

struct RandomFlock {
    std::vector<float> x, y, z, velocityX, velocityY, velocityZ;

    /// In a ball; `far`: every 97th boid is much farther away.
    RandomFlock(std::size_t count, float radius, float far) {
        for (auto* column : {&x, &y, &z, &velocityX, &velocityY, &velocityZ}) column->resize(count);
        for (std::size_t i = 0; i < count; ++i) {
            const auto u = maths::uniform4(7, 1, i), v = maths::uniform4(7, 2, i);
            const glm::vec3 p = (i % 97 == 0 ? far : radius) * maths::ballPoint(u[0], u[1], u[2], u[3], v[0]);
            x[i] = p.x, y[i] = p.y, z[i] = p.z;
            velocityX[i] = maths::centred(v[1]), velocityY[i] = maths::centred(v[2]),
            velocityZ[i] = maths::centred(v[3]);
        }
    }
    [[nodiscard]] FlockState state() const { return {x, y, z, velocityX, velocityY, velocityZ}; }
};

TEST(Flock, SeesTheSameNeighboursAsAllPairs) {
    struct Case {
        std::size_t count;
        float radius, far;
    };
    const FlockRules rules{0.2f, 0.5f, 0.1f, 2, 3};
    for (const Case& c :
         {Case{1500, 2, 2}, Case{1500, 2, 4000}, Case{300, 0.2f, 0.2f}, Case{1, 1, 1}, Case{400, 60, 60}}) {
        const RandomFlock flock(c.count, c.radius, c.far);
        std::vector<glm::vec3> fast(c.count), plain(c.count);
        Flock().accelerate(rules, flock.state(), fast);
        accelerateByAllPairs(rules, flock.state(), plain);
        for (std::size_t i = 0; i < c.count; ++i)
            ASSERT_LT(glm::distance(fast[i], plain[i]), 2e-5f * (1 + glm::length(plain[i])) * std::sqrt(float(c.count)))
                << c.count << ' ' << c.radius << ' ' << i;
    }
}

TEST(Flock, OfManyIsThatOfOneNeighbourAtATime) {
    const FlockRules rules{0.2f, 0.5f, 0.1f, 2, 3};
    for (const float radius : {1.5f, 6.0f}) {
        const RandomFlock flock(20'011, radius, radius);
        std::vector<glm::vec3> fast(20'011), plain(20'011);
        Flock().accelerate(rules, flock.state(), fast);
        accelerateOneByOne(rules, flock.state(), plain);
        for (std::size_t i = 0; i < fast.size(); ++i)
            ASSERT_LT(glm::distance(fast[i], plain[i]), 3e-4f * (1 + glm::length(plain[i]))) << radius << ' ' << i;
    }
}

TEST(Flock, SeparationKeepsMomentum) {
    const RandomFlock flock(2000, 1.5f, 1.5f);
    std::vector<glm::vec3> a(2000);
    Flock().accelerate({0.3f, 0.5f, 1, 0, 0}, flock.state(), a);
    glm::dvec3 sum(0);
    double sizes = 0;
    for (const glm::vec3& each : a) sum += glm::dvec3(each), sizes += static_cast<double>(glm::length(each));
    EXPECT_GT(sizes, 1000);
    EXPECT_LT(glm::length(sum), 1e-5 * sizes);
}

TEST(PointGrid, OrdersEveryPointOnceAndItsRunsHoldAllNeighbours) {
    for (const float far : {2.0f, 900.0f}) {
        const RandomFlock points(3000, 2, far);
        PointGrid grid;
        grid.build(points.x, points.y, points.z, 0.25f);
        const std::set<std::uint32_t> all(grid.order().begin(), grid.order().end());
        ASSERT_EQ(all.size(), 3000u);
        for (std::uint32_t i = 0; i < 3000; i += 7) {
            std::set<std::uint32_t> held;
            grid.forEachRun({points.x[i], points.y[i], points.z[i]}, [&](const PointGrid::Run& run) {
                for (std::uint32_t k = run.first; k < run.end; ++k) EXPECT_TRUE(held.insert(grid.order()[k]).second);
            });
            for (std::uint32_t j = 0; j < 3000; ++j)
                if (std::hypot(points.x[i] - points.x[j], points.y[i] - points.y[j], points.z[i] - points.z[j]) <
                    0.25f) {
                    EXPECT_TRUE(held.contains(j));
                }
        }
    }
}

std::string boids(int count, const std::string& more) {
    return "emission = { part = \"bursts\", count = " + std::to_string(count) +
           ", duration_seconds = 0, interval_seconds = 1e6 }\n"
           "position = { part = \"sphere\", at = \"place\", place = [0, 20, 0], radius_metres = 1.5 }\n"
           "velocity = { part = \"random\", speed = 0.3, variation = 0.3 }\n"
           "colour = { part = \"constant\" }\nsize = { part = \"constant\" }\n"
           "life = [ { part = \"lifetime\", average_seconds = 1e6, variation_seconds = 0 } ]\n"
           "force = [ { part = \"boids\", near_metres = 0.3, sight_metres = 0.9, separation = 0.3, matching = 6, "
           "cohesion = 2 } " +
           more + " ]\n";
}

void flySteps(ParticleSystem& system, int steps) {
    const scene::Scene scene;
    for (int i = 0; i < steps; ++i) {
        const scene::SceneState state;
        system.update({scene, state, 1.0 / 60});
    }
}

/// |Σ v/|v||/N: 1 if all fly the same way, about 1/√N if each flies its own.
double orderOf(const ParticleStore& s) {
    glm::dvec3 sum(0);
    for (std::size_t i = 0; i < s.size(); ++i)
        sum += glm::normalize(glm::dvec3(s.velocityX[i], s.velocityY[i], s.velocityZ[i]));
    return glm::length(sum) / static_cast<double>(s.size());
}

TEST(Boids, OrderRisesFromRandomToThatOfAFlockForAnySeedAndSize) {
    // At the start 1/√N within four of its deviations, about 0.4/√N each.
    for (const int count : {100, 200, 300})
        for (const std::uint64_t seed : {1, 2, 3}) {
            auto system = test::systemFrom(boids(count, ""), seed);
            flySteps(system, 1);
            EXPECT_LT(orderOf(system.store()), 2.6 / std::sqrt(count)) << count << ' ' << seed;
            flySteps(system, 900);
            const ParticleStore& s = system.store();
            EXPECT_GT(orderOf(s), 0.9) << count << ' ' << seed;
            double speed = 0;
            for (std::size_t i = 0; i < s.size(); ++i)
                speed += static_cast<double>(std::hypot(s.velocityX[i], s.velocityY[i], s.velocityZ[i])) /
                         static_cast<double>(s.size());
            EXPECT_NEAR(speed, 2, 0.2);  // the cruising speed
        }
    // Without matching, a flock has no common direction.
    auto blind = test::systemFrom(test::with(boids(300, ""), "matching = 6", "matching = 0"));
    flySteps(blind, 900);
    EXPECT_LT(orderOf(blind.store()), 0.5);
}

TEST(Boids, NoneEntersAnObstacleAndFewReachIt) {
    const auto reaching = [](const std::string& maximum) {
        auto system = test::systemFrom(
            boids(600,
                  ", { part = \"attractor\", law = \"d\", place = [0, 20, 0], strength = 0.6 }, "
                  "{ part = \"avoid\", place = [0.5, 20, 0], radius_metres = 0.7, maximum_acceleration = " +
                      maximum + " }"));
        // Those that are born inside may leave.
        flySteps(system, 240);
        int near = 0;
        for (int i = 0; i < 600; ++i) {
            flySteps(system, 1);
            for (std::size_t k = 0; k < system.store().size(); ++k) {
                const float distance = glm::distance(system.store().position(k), glm::vec3(0.5f, 20, 0));
                EXPECT_GE(distance, 0.7f);
                near += distance < 0.72f ? 1 : 0;
            }
        }
        return near;
    };
    const int blind = reaching("0"), steering = reaching("30");
    EXPECT_GT(blind, 300);
    EXPECT_LT(steering, blind / 4);
}

TEST(Boids, AreTheSameBitForBitAtAnyNumberOfThreads) {
    const tbb::global_control eight(tbb::global_control::max_allowed_parallelism, 8);
    std::set<std::uint64_t> hashes;
    for (const int threads : {1, 2, 3, 8}) {
        auto system = test::systemFrom(boids(3000, ", { part = \"avoid\", place = [0.5, 20, 0] }"));
        tbb::task_arena(threads).execute([&] { flySteps(system, 10); });
        hashes.insert(system.stateHash());
    }
    EXPECT_EQ(hashes.size(), 1u);
}

}  // namespace
}  // namespace dustbench::particles
