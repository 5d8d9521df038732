// Tests that particles collide with solids that move and deform.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <numbers>

#include "methods/kit/particles/test_world.h"

namespace dustbench::particles {
namespace {

constexpr double stepSeconds = 1.0 / 64;

/// With the corners of a cube, pushed out to the unit sphere in each of `rounds` subdivisions.
scene::Mesh ball(int rounds) {
    scene::Mesh mesh;
    for (int i = 0; i < 8; ++i)
        mesh.positions.push_back(glm::normalize(glm::vec3(i & 1 ? 1 : -1, i & 2 ? 1 : -1, i & 4 ? 1 : -1)));
    mesh.indices = {0, 4, 6, 0, 6, 2, 1, 3, 7, 1, 7, 5, 0, 1, 5, 0, 5, 4,
                    2, 6, 7, 2, 7, 3, 0, 2, 3, 0, 3, 1, 4, 5, 7, 4, 7, 6};
    for (int round = 0; round < rounds; ++round) {
        std::vector<std::uint32_t> finer;
        for (std::size_t i = 0; i < mesh.indices.size(); i += 3) {
            const std::uint32_t corners[3] = {mesh.indices[i], mesh.indices[i + 1], mesh.indices[i + 2]};
            std::uint32_t middles[3];
            for (std::size_t k = 0; k < 3; ++k) {
                middles[k] = static_cast<std::uint32_t>(mesh.positions.size());
                mesh.positions.push_back(
                    glm::normalize(mesh.positions[corners[k]] + mesh.positions[corners[(k + 1) % 3]]));
            }
            for (const std::uint32_t index : {corners[0], middles[0], middles[2], middles[0], corners[1], middles[1],
                                              middles[2], middles[1], corners[2], middles[0], middles[1], middles[2]})
                finer.push_back(index);
        }
        mesh.indices = finer;
    }
    mesh.normals = mesh.positions;
    mesh.colours.assign(mesh.positions.size(), glm::vec3(0.5f));
    return mesh;
}

/// A ball stretched along z that moves back and forth and turns, or that pulsates.
struct World {
    explicit World(scene::SolidMotion motion, int rounds = 2) {
        scene.solids = {{"ball", std::make_shared<scene::Mesh>(ball(rounds)), motion}};
        scene.solidPoses.resize(1);
    }
    [[nodiscard]] scene::SceneState moving(double time) const {
        const double angle = 2.1 * time;
        glm::dmat4 toWorld = glm::translate(glm::dmat4(1), {0.8 * std::sin(3 * time), 3, 0});
        toWorld = glm::rotate(toWorld, angle, glm::normalize(glm::dvec3(1, 2, 0.5)));
        scene::SceneState state;
        state.timeSeconds = time;
        scene::SolidPose pose{glm::mat4(glm::scale(toWorld, glm::dvec3(0.6))),
                              {static_cast<float>(2.4 * std::cos(3 * time)), 0, 0},
                              2.1f * glm::normalize(glm::vec3(1, 2, 0.5f))};
        state.solids = {{pose, nullptr}};
        return state;
    }
    /// Wider along x and narrower along z, and back.
    [[nodiscard]] scene::SceneState breathing(double time, double amount = 0.4) const {
        const glm::vec3 wide(1, 0, -0.5f);
        const auto share = static_cast<float>(amount * std::sin(4 * time)),
                   perSecond = static_cast<float>(4 * amount * std::cos(4 * time));
        auto shape = std::make_shared<scene::DeformedMesh>(scene::DeformedMesh{*scene.solids[0].mesh, {}});
        for (glm::vec3& position : shape->mesh.positions) {
            shape->velocities.push_back(perSecond * wide * position);
            position += share * wide * position;
        }
        scene::SceneState state;
        state.timeSeconds = time;
        scene::SolidPose pose;
        pose.toWorld[3] = glm::vec4(0, 3, 0, 1);
        state.solids = {{pose, shape}};
        return state;
    }
    /// Depth of a point below the ball's surface, which is not quite convex; negative outside.
    [[nodiscard]] double depth(const scene::SceneState& state, const glm::vec3& point) const {
        const scene::Mesh& mesh = scene::solidMesh(scene, state, 0);
        const glm::dmat4 toWorld(scene::solidPose(scene, state, 0).toWorld);
        double solidAngle = 0, distance = INFINITY;
        for (std::size_t i = 0; i < mesh.indices.size(); i += 3) {
            const auto corner = [&](std::size_t k) {
                return glm::dvec3(toWorld * glm::dvec4(mesh.positions[mesh.indices[i + k]], 1)) - glm::dvec3(point);
            };
            const glm::dvec3 a = corner(0), b = corner(1), c = corner(2), normal = glm::cross(b - a, c - a);
            const double la = glm::length(a), lb = glm::length(b), lc = glm::length(c);
            solidAngle += 2 * std::atan2(glm::dot(a, glm::cross(b, c)), la * lb * lc + glm::dot(a, b) * lc +
                                                                            glm::dot(b, c) * la + glm::dot(c, a) * lb);
            distance = std::min(distance, std::abs(glm::dot(normal, a)) / glm::length(normal));
        }
        return solidAngle > 2 * std::numbers::pi ? distance : -distance;
    }

    scene::Scene scene;
};

/// Particles in a ball that fly along x and bounce on the scene.
ParticleSystem movingSwarm(int count, const std::string& place, double radius, double speed,
                           const std::string& bounce) {
    return test::systemFrom(
        "emission = { part = \"bursts\", count = " + std::to_string(count) +
        ", duration_seconds = 0, interval_seconds = 1e6 }\nposition = { part = \"sphere\", at = \"place\", place = " +
        place + ", radius_metres = " + std::to_string(radius) + " }\nvelocity = { part = \"fixed\", direction = [" +
        (speed < 0 ? "-1" : "1") + ", 0, 0], speed = " + std::to_string(std::abs(speed)) +
        " }\ncolour = { part = \"constant\" }\nsize = { part = \"constant\", radius_metres = 0 }\n"
        "life = [ { part = \"lifetime\", average_seconds = 1e5, variation_seconds = 0 } ]\n"
        "force = [ { part = \"bounce\", shape = \"scene\", " +
        bounce + " } ]\n");
}

/// Swarms fly at the solid from either side.
template <typename StateAt>
void expectNoneInside(const World& world, const StateAt& stateAt) {
    for (const double speed : {2.0, -2.0}) {
        auto system = movingSwarm(200, speed > 0 ? "[-2.6, 3, 0]" : "[2.6, 3.2, 0.1]", 0.7, speed,
                                  "restitution = 0.3, friction = 0.2");
        double deepest = -INFINITY;
        for (int i = 1; i <= 130; ++i) {
            const scene::SceneState state = stateAt(i * stepSeconds);
            system.update({world.scene, state, stepSeconds});
            for (std::size_t k = 0; k < system.store().size(); ++k)
                deepest = std::max(deepest, world.depth(state, system.store().position(k)));
        }
        const auto turned =
            std::ranges::count_if(system.store().velocityX, [&](float v) { return (v > 0) != (speed > 0); });
        EXPECT_LE(deepest, 1e-6) << speed;
        EXPECT_GT(turned, 25) << "few have met it";
    }
}

TEST(MovingSolids, NoParticleGetsIntoASolidThatMovesAndTurns) {
    const World world(scene::SolidMotion::moves);
    expectNoneInside(world, [&](double time) { return world.moving(time); });
}

TEST(MovingSolids, NoParticleGetsIntoASolidThatDeforms) {
    const World world(scene::SolidMotion::deforms);
    expectNoneInside(world, [&](double time) { return world.breathing(time); });
}

TEST(MovingSolids, ASurfaceThatSwellsTakesParticlesAlong) {
    // At rest at the ball's pole along x, which is at 1 + 0.4 sin 4t: v' = (1 + e)·dx/dt at the moment of contact.
    const World world(scene::SolidMotion::deforms, 4);
    for (const double e : {0.0, 0.5}) {
        auto system = movingSwarm(1, "[1.2, 3, 0]", 0, 0, "restitution = " + std::to_string(e));
        double met = 0;
        for (int i = 1; i * stepSeconds < 0.25; ++i) {
            const scene::SceneState state = world.breathing(i * stepSeconds);
            system.update({world.scene, state, stepSeconds});
            if (met > 0 || system.store().velocityX.empty() || system.store().velocityX[0] == 0) continue;
            met = i * stepSeconds;
            const double speed = 1.6 * std::cos(4 * met);
            EXPECT_NEAR(static_cast<double>(system.store().velocityX[0]), (1 + e) * speed, 0.08 * speed);
        }
        EXPECT_NEAR(met, std::asin(0.5) / 4, 0.03) << "1.2 at the facets' middles";
    }
}

TEST(MovingSolids, WhatStandsIsMetAsIfItWereStillBitForBit) {
    for (const scene::SolidMotion motion : {scene::SolidMotion::moves, scene::SolidMotion::deforms}) {
        const World world(motion);
        World still(scene::SolidMotion::still);
        still.scene.solidPoses[0] = world.moving(0.3).solids[0].pose;
        scene::SceneState standing = world.moving(0.3);
        standing.solids[0].pose.velocity = standing.solids[0].pose.angularVelocity = glm::vec3(0);
        if (motion == scene::SolidMotion::deforms) standing.solids[0].shape = world.breathing(0, 0).solids[0].shape;
        auto one = movingSwarm(500, "[-2.6, 3, 0]", 0.7, 2, "restitution = 0.9"),
             other = movingSwarm(500, "[-2.6, 3, 0]", 0.7, 2, "restitution = 0.9");
        for (int i = 1; i <= 150; ++i) {
            if (motion == scene::SolidMotion::deforms)  // another object with the same content each time
                standing.solids[0].shape = std::make_shared<scene::DeformedMesh>(*standing.solids[0].shape);
            one.update({world.scene, standing, stepSeconds});
            other.update({still.scene, scene::SceneState(), stepSeconds});
        }
        EXPECT_EQ(one.stateHash(), other.stateHash());
        EXPECT_GT(std::ranges::count_if(one.store().velocityX, [](float v) { return v < 0; }), 50);
    }
}

}  // namespace
}  // namespace dustbench::particles
