// Compares deaths with closed forms: after a delay, by speed and place, out of sight, in a position step.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "methods/contract/errors.h"
#include "methods/kit/particles/test_world.h"

namespace dustbench::particles {
namespace {

constexpr double lifeStep = 1.0 / 64;

/// `count` particles born at once; `rest` has position, velocity, life and force.
std::string atOnce(int count, const std::string& rest) {
    return "emission = { part = \"bursts\", count = " + std::to_string(count) +
           ", duration_seconds = 0, interval_seconds = 1e6 }\ncolour = { part = \"constant\" }\n"
           "size = { part = \"constant\", radius_metres = 0.01 }\n" +
           rest;
}

void live(ParticleSystem& system, int steps, const scene::View* view = nullptr) {
    const scene::Scene scene;
    const scene::SceneState state;
    for (int i = 0; i < steps; ++i)
        system.update({.scene = scene, .state = state, .stepSeconds = lifeStep, .view = view});
}

int stepsUntilEmpty(const std::string& toml) {
    auto system = test::systemFrom(toml);
    live(system, 1);
    int steps = 1;
    for (; !system.store().empty() && steps < 1000; ++steps) live(system, 1);
    return steps;
}

const std::string immortal = "{ part = \"lifetime\", average_seconds = 1e5, variation_seconds = 0 }";

TEST(CollisionDeath, FollowsTheContactAfterTheDelayAtAnyPointOfAStep) {
    // 1.01 m at 2 m/s: contact at 0.505 s, within the 33rd step.
    const auto falling = [](const std::string& more) {
        return atOnce(1,
                      "position = { part = \"point\", at = \"place\", place = [0, 1.01, 0] }\n"
                      "velocity = { part = \"fixed\", direction = [0, -1, 0], speed = 2 }\nlife = [ " +
                          immortal + ", { part = \"collision\"" + more + " } ]\n");
    };
    EXPECT_EQ(stepsUntilEmpty(falling("")), 33);
    for (const double delay : {0.1, 0.25, 1.0, 3.003}) {
        const int due = static_cast<int>(std::ceil((0.505 + delay) / lifeStep));
        EXPECT_EQ(stepsUntilEmpty(falling(", delay_seconds = " + std::to_string(delay))), due) << delay;
        // As printed: from the step before the one that would hit.
        const int printed = static_cast<int>(std::ceil(32.0 + 1 + delay / lifeStep));
        EXPECT_NEAR(stepsUntilEmpty(falling(", mode = \"paper\", delay_seconds = " + std::to_string(delay))), printed,
                    1)
            << delay;
    }
}

TEST(CollisionDeath, LeavesThePartsMotionUntilThen) {
    auto system = test::systemFrom(
        atOnce(1,
               "position = { part = \"point\", at = \"place\", place = [0, 1, 0] }\n"
               "velocity = { part = \"fixed\", direction = [0.6, -0.8, 0], speed = 5 }\nlife = [ " +
                   immortal + ", { part = \"collision\", delay_seconds = 2, restitution = 0.5, friction = 0.25 } ]\n"));
    live(system, 64);
    ASSERT_EQ(system.store().size(), 1u);
    EXPECT_NEAR(system.store().velocityX[0], 3 * 0.75, 1e-5);
    EXPECT_NEAR(system.store().velocityY[0], 4 * 0.5, 1e-5);
    EXPECT_NEAR(system.store().lifetime[0], 0.25 + 2, 1e-5);
}

TEST(Lifetime, GrowsWithSpeedAndPlaceAsStated) {
    auto system = test::systemFrom(
        atOnce(500,
               "position = { part = \"sphere\", at = \"place\", place = [1, 20, 3], radius_metres = 2 }\n"
               "velocity = { part = \"random\", speed = 4, variation = 0.5 }\nlife = [ { part = \"lifetime\", "
               "average_seconds = 50, variation_seconds = 0, per_speed = 0.5, mean_speed = 4, "
               "per_metre = [1, -2, 0.5], mean_place = [1, 20, 3] } ]\n"));
    live(system, 1);
    const ParticleStore& s = system.store();
    ASSERT_EQ(s.size(), 500u);
    double mean = 0;
    for (std::size_t i = 0; i < s.size(); ++i) {
        const glm::dvec3 v(s.velocityX[i], s.velocityY[i], s.velocityZ[i]);
        const glm::dvec3 born = glm::dvec3(s.position(i)) - static_cast<double>(s.age[i]) * v;
        const double expected =
            50 + 0.5 * (glm::length(v) - 4) + glm::dot(glm::dvec3(1, -2, 0.5), born - glm::dvec3(1, 20, 3));
        ASSERT_NEAR(s.lifetime[i], expected, 1e-4);
        mean += static_cast<double>(s.lifetime[i]) / 500;
    }
    EXPECT_NEAR(mean, 50, 0.5);
}

/// How far a point is outside the picture, in units of its half; from the matrices of the view.
double outside(const scene::View& view, const glm::vec3& point) {
    const glm::dvec4 clip = glm::dmat4(view.worldToClip()) * glm::dvec4(point, 1);
    if (clip.w <= 0) return 1e9;
    return std::max(std::abs(clip.x), std::abs(clip.y)) / clip.w - 1;
}

TEST(OutOfSight, KillsAllWhoLeaveThePictureAndNobodyWithinIt) {
    scene::View view;
    view.camera.eye = {3, 6, 8};
    view.camera.target = {0, 5, 0};
    view.width = 320, view.height = 180;
    const auto toml = [](const std::string& more) {
        return atOnce(800,
                      "position = { part = \"point\", at = \"place\", place = [0, 5, 0] }\n"
                      "velocity = { part = \"random\", speed = 6, variation = 0.3 }\nlife = [ " +
                          immortal + more + " ]\n");
    };
    auto evaluated = test::systemFrom(toml(", { part = \"out_of_sight\", margin_metres = 0 }"));
    auto all = test::systemFrom(toml(""));
    for (int step = 0; step < 200; ++step) {
        std::map<std::uint64_t, glm::vec3> before;
        for (std::size_t i = 0; i < all.store().size(); ++i) before[all.store().serial[i]] = all.store().position(i);
        const std::set<std::uint64_t> livedBefore(evaluated.store().serial.begin(), evaluated.store().serial.end());
        live(evaluated, 1, &view);
        live(all, 1);
        const std::set<std::uint64_t> lives(evaluated.store().serial.begin(), evaluated.store().serial.end());
        for (const std::uint64_t serial : livedBefore) {
            const double far = outside(view, before.at(serial));
            if (lives.contains(serial))
                EXPECT_LT(far, 0.05);  // its radius
            else
                EXPECT_GT(far, 0);
        }
    }
    EXPECT_LT(evaluated.store().size(), 200u);
    EXPECT_EQ(all.store().size(), 800u);
    EXPECT_THROW(live(evaluated, 1), InputError);
}

TEST(OutOfSight, HasALimitOfDistance) {
    scene::View view;
    view.camera.eye = {0, 0, 0};
    view.camera.target = {0, 0, -1};
    auto system = test::systemFrom(
        atOnce(1,
               "position = { part = \"point\", at = \"place\" }\nvelocity = { part = \"fixed\", direction = [0, 0, "
               "-1], speed = 1 }\nlife = [ " +
                   immortal + ", { part = \"out_of_sight\", margin_metres = 0, farthest_metres = 1 } ]\n"));
    live(system, 64, &view);
    EXPECT_EQ(system.store().size(), 1u);
    live(system, 3, &view);
    EXPECT_EQ(system.store().size(), 0u);
}

TEST(CollisionDeath, HappensInAPositionStepToThePointsThatTouch) {
    // A row of 20 points, 0.1 m apart, falls on a ball of 0.45 m below its middle: points 6 to 13 hit it, which cuts
    // the row. The springs are soft, so that each point falls almost freely.
    const auto row = [](const std::string& step, const std::string& delay) {
        return atOnce(20,
                      "position = { part = \"lattice\", columns = 20, rows = 1, place = [-0.95, 2, 0], column_step = "
                      "[0.1, 0, 0] }\nvelocity = { part = \"fixed\", speed = 0 }\nlife = [ " +
                          immortal + ", { part = \"collision\", shape = \"sphere\", radius_metres = 0.4" + delay +
                          " } ]\nforce = [ { part = \"gravity\" }, { part = \"springs\", stiffness = 0.01, step = \"" +
                          step + "\" } ]\n");
    };
    for (const std::string step : {"explicit", "position"}) {
        auto system = test::systemFrom(row(step, ""));
        live(system, 60);
        std::set<std::uint64_t> lives(system.store().serial.begin(), system.store().serial.end());
        EXPECT_EQ(lives, (std::set<std::uint64_t>{0, 1, 2, 3, 4, 5, 14, 15, 16, 17, 18, 19})) << step;
        auto late = test::systemFrom(row(step, ", delay_seconds = 0.5"));
        live(late, 60);
        EXPECT_EQ(late.store().size(), 20u) << step;
        live(late, 20);
        EXPECT_EQ(late.store().size(), 12u) << step;
    }
}

TEST(OutOfReach, KillsWhoIsFartherFromTheSourceThanItsReach) {
    auto system = test::systemFrom(
        atOnce(300,
               "position = { part = \"point\", at = \"place\", place = [1, 2, 3] }\n"
               "velocity = { part = \"random\", speed = 2, variation = 0 }\nlife = [ " +
                   immortal + ", { part = \"out_of_reach\", place = [1, 2, 3], reach_metres = 1.51 } ]\n"));
    float nearest = 0, farthest = 0;
    for (int step = 0; step < 200; ++step) {
        live(system, 1);
        if (system.store().empty()) break;
        ASSERT_EQ(system.store().size(), 300u) << "all are as far";
        nearest = INFINITY, farthest = 0;
        for (std::size_t i = 0; i < system.store().size(); ++i) {
            const float distance = glm::distance(system.store().position(i), glm::vec3(1, 2, 3));
            nearest = std::min(nearest, distance);
            farthest = std::max(farthest, distance);
        }
    }
    EXPECT_TRUE(system.store().empty());
    EXPECT_GT(farthest, 1.51f) << "nobody dies within";
    EXPECT_LT(nearest, 1.51f + 2 * static_cast<float>(lifeStep) + 1e-4f) << "and nobody lives beyond for a whole step";
}

TEST(OutOfReach, FollowsTheNearestWheel) {
    auto system = test::systemFrom(
        atOnce(1,
               "position = { part = \"point\", at = \"place\", place = [0, 0.1, 0] }\n"
               "velocity = { part = \"fixed\", speed = 0 }\nlife = [ " +
                   immortal + ", { part = \"out_of_reach\", from = \"wheels\", reach_metres = 3 } ]\n"));
    const scene::Scene scene = test::sceneWithCar();
    bool lived = true;
    for (int i = 1; i <= 64; ++i) {
        const scene::SceneState state = test::drivingStraight(i * lifeStep, 10);
        double nearest = INFINITY;
        for (const scene::WheelState& wheel : state.vehicle.wheels)
            nearest = std::min(nearest, glm::distance(wheel.contact, glm::dvec3(0, 0.1, 0)));
        system.update({.scene = scene, .state = state, .stepSeconds = lifeStep});
        const bool lives = !system.store().empty();
        if (std::abs(nearest - 3) > 0.2) {
            EXPECT_EQ(lives, lived && nearest < 3) << i;
        }
        lived = lived && lives;
    }
    EXPECT_FALSE(lived);
}

}  // namespace
}  // namespace dustbench::particles
