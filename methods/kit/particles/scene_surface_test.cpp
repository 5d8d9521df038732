// Tests that particles bounce on the contents of a scene: ground, solids, and the moving vehicle.
#include "methods/kit/particles/scene_surface.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "methods/kit/particles/test_world.h"

namespace dustbench::particles {
namespace {

constexpr double surfaceStepSeconds = 1.0 / 64;
const glm::vec3 boxMinimum(-0.8f, 0.4f, -0.9f), boxMaximum(3.4f, 1.4f, 0.9f);

std::shared_ptr<const scene::Mesh> boxMesh(const glm::vec3& low, const glm::vec3& high) {
    auto mesh = std::make_shared<scene::Mesh>();
    for (int i = 0; i < 8; ++i)
        mesh->positions.emplace_back(i & 1 ? high.x : low.x, i & 2 ? high.y : low.y, i & 4 ? high.z : low.z);
    mesh->indices = {0, 4, 6, 0, 6, 2, 1, 3, 7, 1, 7, 5, 0, 1, 5, 0, 5, 4,
                     2, 6, 7, 2, 7, 3, 0, 2, 3, 0, 3, 1, 4, 5, 7, 4, 7, 6};
    return mesh;
}

/// A car whose body is a box.
scene::Scene sceneWithBox() {
    scene::Scene scene;
    scene.vehicle.emplace();
    scene.vehicle->body.mesh = boxMesh(boxMinimum, boxMaximum);
    return scene;
}

/// On a circle of `radius` metres (0: straight on along +X), at any time.
scene::SceneState driving(double time, double speed, double acceleration = 0, double radius = 0) {
    const double way = speed * time + acceleration * time * time / 2;
    scene::SceneState state;
    scene::VehicleState& car = state.vehicle;
    state.timeSeconds = time;
    car.speed = speed + acceleration * time;
    car.heading = radius > 0 ? way / radius : 0;
    car.position = radius > 0 ? glm::dvec3(radius * std::sin(car.heading), 0, radius * (std::cos(car.heading) - 1))
                              : glm::dvec3(way, 0, 0);
    const glm::dmat4 toWorld = car.toWorld();
    for (std::size_t i = 0; i < 4; ++i) {
        scene::WheelState& wheel = car.wheels[i];
        wheel.contact = glm::dvec3(toWorld * glm::dvec4(i < 2 ? 2.6 : 0.0, 0, i % 2 ? 0.775 : -0.775, 1));
        wheel.hub = wheel.contact + glm::dvec3(0, 0.33, 0);
        wheel.forward = car.forward();
        wheel.velocity = car.forward() * car.speed;
        wheel.spinRate = car.speed / 0.33;
    }
    return state;
}

std::string surfaceSwarm(const std::string& place, double radius, const std::string& velocity,
                         const std::string& forces, int count = 1) {
    return "emission = { part = \"bursts\", count = " + std::to_string(count) +
           ", duration_seconds = 0, interval_seconds = 1e6 }\n"
           "position = { part = \"sphere\", at = \"place\", place = " +
           place + ", radius_metres = " + std::to_string(radius) + " }\nvelocity = { " + velocity +
           " }\ncolour = { part = \"constant\" }\nsize = { part = \"constant\", radius_metres = 0 }\n"
           "life = [ { part = \"lifetime\", average_seconds = 1e5, variation_seconds = 0 } ]\nforce = [ " +
           forces + " ]\n";
}

glm::dvec3 velocityOf(const ParticleStore& store, std::size_t i) {
    return {store.velocityX[i], store.velocityY[i], store.velocityZ[i]};
}

const std::string standing = "part = \"fixed\", speed = 0";

TEST(SceneSurface, AMovingCarGivesItsVelocity) {
    // At rest 2 m in front of the bumper: v' = (1 + e)·V, from the moment of contact on.
    const scene::Scene scene = sceneWithBox();
    for (const double e : {0.0, 0.25, 1.0})
        for (const double speed : {3.0, 20.0, 60.0}) {
            auto system = test::systemFrom(
                surfaceSwarm("[5.4, 1, 0]", 0, standing,
                             "{ part = \"bounce\", shape = \"scene\", restitution = " + std::to_string(e) + " }"));
            const double met = 2 / speed;
            double time = 0;
            while (time < met + 0.2) {
                time += surfaceStepSeconds;
                const scene::SceneState state = driving(time, speed);
                system.update({scene, state, surfaceStepSeconds});
            }
            const ParticleStore& s = system.store();
            EXPECT_NEAR(s.velocityX[0], (1 + e) * speed, 1e-4 * speed) << e << ", " << speed;
            EXPECT_NEAR(s.x[0], 5.4 + (time - met) * (1 + e) * speed, 2e-3) << e << ", " << speed;
            EXPECT_NEAR(s.velocityY[0], 0, 1e-5);
        }
}

TEST(SceneSurface, MirrorsTheVelocityRelativeToTheCar) {
    // Onto the roof from above, and on the flank from the side; friction 0.25 removes a quarter of the sliding speed.
    const scene::Scene scene = sceneWithBox();
    const double speed = 8;
    struct Case {
        const char *place, *velocity;
        glm::dvec3 before, normal;
    };
    for (const Case& c :
         {Case{"[2, 2.4, 0]", "part = \"fixed\", direction = [0, -1, 0], speed = 5", {0, -5, 0}, {0, 1, 0}},
          Case{"[2, 1, 1.9]", "part = \"fixed\", direction = [0.6, 0, -0.8], speed = 10", {6, 0, -8}, {0, 0, 1}}}) {
        auto system = test::systemFrom(surfaceSwarm(
            c.place, 0, c.velocity, "{ part = \"bounce\", shape = \"scene\", restitution = 0.5, friction = 0.25 }"));
        for (int i = 1; i <= 24; ++i) {
            const scene::SceneState state = driving(i * surfaceStepSeconds, speed);
            system.update({scene, state, surfaceStepSeconds});
        }
        const glm::dvec3 carried(speed, 0, 0), relative = c.before - carried;
        const glm::dvec3 across = glm::dot(relative, c.normal) * c.normal;
        const glm::dvec3 expected = carried + 0.75 * (relative - across) - 0.5 * across;
        EXPECT_NEAR(glm::distance(velocityOf(system.store(), 0), expected), 0, 1e-4) << c.place;
    }
}

TEST(SceneSurface, MeetsTheCarWhereItIsWithinTheStep) {
    // Shots at the flank of a car that drives a metre per step: those behind its rear at the moment of contact pass.
    const scene::Scene scene = sceneWithBox();
    const double speed = 60, shot = 64;
    auto text = surfaceSwarm("[0, 0, 0]", 0, "part = \"fixed\", direction = [0, 0, -1], speed = 64",
                             "{ part = \"bounce\", shape = \"scene\", restitution = 1 }", 2000);
    const std::string from = "part = \"sphere\", at = \"place\", place = [0, 0, 0], radius_metres = 0.000000";
    text.replace(text.find(from), from.size(),
                 "part = \"line\", at = \"place\", place = [1.6, 1, 3], direction = [1, 0, 0], length_metres = 4, base "
                 "= \"middle\"");
    auto system = test::systemFrom(text);
    const int steps = 5;
    for (int i = 1; i <= steps; ++i) {
        const scene::SceneState state = driving(i * surfaceStepSeconds, speed);
        system.update({scene, state, surfaceStepSeconds});
    }
    const ParticleStore& s = system.store();
    int met = 0, passed = 0;
    for (std::size_t i = 0; i < s.size(); ++i) {
        const double born = steps * surfaceStepSeconds - static_cast<double>(s.age[i]), contact = born + 2.1 / shot;
        const double behind = -0.8 + speed * contact - static_cast<double>(s.x[i]);
        if (std::abs(behind) < 0.01) continue;
        ASSERT_EQ(s.velocityZ[i] > 0, behind < 0) << s.x[i];
        ++(behind < 0 ? met : passed);
    }
    EXPECT_GT(met, 300);
    EXPECT_GT(passed, 300);
}

TEST(SceneSurface, WhatSticksRidesAlongHoweverTheCarMoves) {
    const scene::Scene scene = sceneWithBox();
    for (const double radius : {0.0, 12.0}) {
        auto system = test::systemFrom(surfaceSwarm("[1.5, 2, 0]", 0.3, standing,
                                                    "{ part = \"gravity\" }, { part = \"bounce\", shape = \"scene\", "
                                                    "restitution = 0, friction = 1 }",
                                                    50));
        double time = 0;
        const auto advance = [&](int steps, double acceleration) {
            for (int i = 0; i < steps; ++i) {
                time += surfaceStepSeconds;
                const scene::SceneState state = driving(time, 0, acceleration, radius);
                system.update({scene, state, surfaceStepSeconds});
            }
        };
        const auto ofCar = [&] {
            std::vector<glm::dvec3> list;
            const glm::dmat4 toCar = glm::inverse(driving(time, 0, 3, radius).vehicle.toWorld());
            for (std::size_t i = 0; i < system.store().size(); ++i)
                list.emplace_back(toCar * glm::dvec4(glm::dvec3(system.store().position(i)), 1));
            return list;
        };
        advance(64, 3);  // all have fallen on the roof
        const auto before = ofCar();
        advance(128, 3);
        const auto after = ofCar();
        for (std::size_t i = 0; i < before.size(); ++i) {
            // It rests about 1e-5 m above the roof and is put back there 128 times, by gravity · step.
            ASSERT_NEAR(before[i].y, 1.4, 1e-3);
            ASSERT_NEAR(glm::distance(before[i], after[i]), 0, 4e-3) << radius;
        }
    }
}

TEST(SceneSurface, AWheelsRimGivesItsSpin) {
    // Friction 1, restitution 0: a particle that touches the top of a wheel leaves with the rim's velocity, 2·V there.
    const scene::Scene scene = sceneWithBox();
    auto free = scene;
    free.vehicle->body.mesh = nullptr;
    auto system = test::systemFrom(
        surfaceSwarm("[0.2, 0.8, 0.775]", 0, "part = \"fixed\", direction = [0, -1, 0], speed = 4",
                     "{ part = \"bounce\", shape = \"scene\", restitution = 0, friction = 1, on_ground = false }"));
    const double speed = 2;
    glm::dvec3 hub(0), at(0), velocity(0);
    for (int i = 1; i <= 10; ++i) {
        const scene::SceneState state = driving(i * surfaceStepSeconds, speed);
        system.update({free, state, surfaceStepSeconds});
        if (system.store().velocityY[0] > -3.9f) {
            hub = state.vehicle.wheels[3].hub;
            at = system.store().position(0);
            velocity = velocityOf(system.store(), 0);
            break;
        }
    }
    // Within the step after the contact the rim turns by up to V/R·Δt = 0.1.
    const glm::dvec3 out = at - hub;
    EXPECT_NEAR(glm::length(glm::dvec2(out)), 0.33, 0.01);
    const double turn = speed / 0.33;
    EXPECT_NEAR(velocity.x, speed + turn * out.y, 0.1 * speed);
    EXPECT_NEAR(velocity.y, -turn * out.x, 0.1 * speed);
    EXPECT_NEAR(glm::length(velocity - glm::dvec3(speed, 0, 0)), speed, 1e-3);  // ωR = V
}

/// Metres inside the car's box or a wheel, or below the ground; negative outside. Where a wheel rolls over a particle
/// on the ground, no point is outside of both: only the ground counts there.
double depthInside(const glm::vec3& point, const scene::SceneState& state) {
    const auto local = glm::dvec3(glm::inverse(state.vehicle.toWorld()) * glm::dvec4(glm::dvec3(point), 1));
    const glm::dvec3 in = glm::min(local - glm::dvec3(boxMinimum), glm::dvec3(boxMaximum) - local);
    double depth = std::max(-static_cast<double>(point.y), std::min({in.x, in.y, in.z}));
    if (point.y < 0.02f) return depth;
    for (const scene::WheelState& wheel : state.vehicle.wheels) {
        const glm::dvec3 axle = glm::normalize(glm::cross(wheel.forward, state.vehicle.up));
        const glm::dvec3 from = glm::dvec3(point) - wheel.hub;
        const double along = glm::dot(from, axle);
        depth = std::max(depth, std::min(0.33 - glm::length(from - along * axle), 0.11 - std::abs(along)));
    }
    return depth;
}

TEST(SceneSurface, NoParticleIsInsideASolid) {
    // A car drives in a circle through a cloud that falls and flies in all directions.
    const scene::Scene scene = sceneWithBox();
    for (const double speed : {0.0, 4.0, 30.0})
        for (const std::string friction : {"0", "0.7"}) {
            auto system =
                test::systemFrom(surfaceSwarm("[6, 6, -3]", 4, "part = \"random\", speed = 12",
                                              "{ part = \"gravity\" }, { part = \"bounce\", shape = \"scene\", "
                                              "restitution = 0.5, friction = " +
                                                  friction + " }",
                                              4000));
            double deepest = -1;
            std::size_t met = 0;
            for (int i = 1; i <= 200; ++i) {
                const scene::SceneState state = driving(i * surfaceStepSeconds, speed, 0, 10);
                system.update({scene, state, surfaceStepSeconds});
                for (std::size_t k = 0; k < system.store().size(); ++k) {
                    const double depth = depthInside(system.store().position(k), state);
                    deepest = std::max(deepest, depth);
                    met += depth > -1e-3;
                }
            }
            EXPECT_GT(met, 1000u);
            EXPECT_LE(deepest, 1e-6) << speed << ", " << friction;
        }
}

TEST(SceneSurface, SolidsOfTheSceneAreMetAsTheyStand) {
    scene::Scene scene;
    scene.solids.push_back({"box", boxMesh({-1, -1, -1}, {1, 1, 1})});
    scene::SolidPose pose;
    pose.toWorld = glm::mat4(0.5f);
    pose.toWorld[3] = glm::vec4(4, 3, 0, 1);
    scene.solidPoses.push_back(pose);
    const scene::SceneState state;
    const auto flown = [&](const std::string& more) {
        auto system =
            test::systemFrom(surfaceSwarm("[0, 3, 0]", 0, "part = \"fixed\", direction = [1, 0, 0], speed = 10",
                                          "{ part = \"bounce\", shape = \"scene\", restitution = 1" + more + " }"));
        for (int i = 0; i < 64; ++i) system.update({scene, state, surfaceStepSeconds});
        return static_cast<double>(system.store().x[0]);
    };
    const double way = 10 * 63.0 / 64 + 10 * surfaceStepSeconds / 2;  // born in the middle of the first step, or about
    EXPECT_NEAR(flown(""), 7 - way, 0.1);                             // there 3.5 m, and back
    EXPECT_NEAR(flown(", on_solids = false"), way, 0.1);
}

TEST(SceneSurface, KillsWhereItIsToldTo) {
    const scene::Scene scene = sceneWithBox();
    auto text = surfaceSwarm("[2, 4, 0]", 0.5, "part = \"fixed\", direction = [0, -1, 0], speed = 3", "", 100);
    text.replace(text.find("variation_seconds = 0 } ]"), 25,
                 "variation_seconds = 0 }, { part = \"collision\", shape = \"scene\" } ]");
    auto system = test::systemFrom(text);
    for (int i = 1; i <= 64 * 2; ++i) {
        system.update({scene, driving(0, 0), surfaceStepSeconds});
        for (const float y : system.store().y) ASSERT_GE(y, 1.4f);
    }
    EXPECT_EQ(system.store().size(), 0u);
}

scene::Terrain surfaceHills(unsigned seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<float> height(-1, 1);
    std::vector<float> heights(9 * 7);
    for (float& h : heights) h = height(random);
    return {heights, 9, 7, 0.75f, -3, -2};
}

TEST(GroundSurface, MeetsTheHeightFieldWhereTheWayFirstFallsBelowIt) {
    // Compared with a search in 20,000 samples of Terrain::heightAt. Seed 5, also beyond the field's edge.
    std::mt19937 random(5);
    std::uniform_real_distribution<float> at(-5, 5), height(-1, 2);
    int met = 0, free = 0;
    for (int i = 0; i < 400; ++i) {
        const scene::Terrain terrain = surfaceHills(static_cast<unsigned>(i % 5));
        glm::vec3 from(at(random), 0, at(random)), to(at(random), height(random), at(random));
        if (i % 7 == 0) to.x = from.x, to.z = from.z, to.y = -2;  // straight down
        from.y = terrain.heightAt(from.x, from.z) + 0.01f + std::abs(height(random));
        const float seconds = 1;
        float share;
        meetGround({1, &from.x, &from.y, &from.z, &to.x, &to.y, &to.z, &seconds}, terrain, &share);
        double first = 2;
        const int samples = 20'000;
        for (int k = 1; k <= samples && first > 1; ++k) {
            const glm::dvec3 p = glm::mix(glm::dvec3(from), glm::dvec3(to), static_cast<double>(k) / samples);
            if (p.y < static_cast<double>(terrain.heightAt(static_cast<float>(p.x), static_cast<float>(p.z))) - 2e-6)
                first = static_cast<double>(k) / samples;
        }
        // Paths that only graze the surface may give either result.
        if (first <= 1 && share > 1) {
            const glm::vec3 p = glm::mix(from, to, static_cast<float>(first));
            ASSERT_NEAR(p.y, terrain.heightAt(p.x, p.z), 1e-3) << i;
            continue;
        }
        if (first > 1) {
            ++free;
            ASSERT_TRUE(share > 1 ||
                        std::abs(glm::mix(from, to, share).y -
                                 terrain.heightAt(glm::mix(from, to, share).x, glm::mix(from, to, share).z)) < 1e-4f)
                << i;
            continue;
        }
        ++met;
        ASSERT_NEAR(static_cast<double>(share), first, 2.0 / samples + 1e-4) << i;
    }
    EXPECT_GT(met, 100);
    EXPECT_GT(free, 20);
}

TEST(GroundSurface, ParticlesStayAboveHills) {
    scene::Scene scene;
    scene.terrain = surfaceHills(3);
    const scene::SceneState state;
    auto system =
        test::systemFrom(surfaceSwarm("[0, 3, 0]", 1.5, "part = \"random\", speed = 15",
                                      "{ part = \"gravity\" }, { part = \"bounce\", shape = \"scene\", restitution "
                                      "= 0.9, friction = 0.1 }",
                                      1000));
    for (int i = 0; i < 400; ++i) {
        system.update({scene, state, surfaceStepSeconds});
        for (std::size_t k = 0; k < system.store().size(); ++k) {
            const glm::vec3 p = system.store().position(k);
            ASSERT_GE(p.y, scene.terrain.heightAt(p.x, p.z) - 1e-6f * (3 + std::abs(p.x) + std::abs(p.z))) << i;
        }
    }
}

}  // namespace
}  // namespace dustbench::particles
