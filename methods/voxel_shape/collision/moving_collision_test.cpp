// Tests that shapes collide with solids that move and deform, and with the vehicle.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <glm/gtc/matrix_transform.hpp>

#include "methods/voxel_shape/collision/shape_collision.h"
#include "methods/voxel_shape/particles/shape_system.h"
#include "methods/voxel_shape/voxels/surface_voxels.h"
#include "methods/voxel_shape/voxels/test_meshes.h"

namespace dustbench::voxel_shape {
namespace {

constexpr double frameSeconds = 1.0 / 60;

/// A ball of 0.5 m, turning, that goes through the origin along x within two seconds; or one at x = 0.9 that pulsates.
struct MovingBall {
    explicit MovingBall(scene::SolidMotion motion) {
        scene.solids = {{"ball", std::make_shared<scene::Mesh>(sphereMesh(0.5f, 16)), motion}};
        scene.solidPoses = {moving(0).solids[0].pose};
    }
    [[nodiscard]] static scene::SceneState moving(double time) {
        scene::SceneState state;
        state.timeSeconds = time;
        scene::SolidPose pose;
        pose.toWorld = glm::rotate(glm::translate(glm::mat4(1), {4 * time - 4, 0.9, 0.1}), static_cast<float>(3 * time),
                                   glm::normalize(glm::vec3(1, 2, 3)));
        pose.velocity = {4, 0, 0};
        state.solids = {{pose, nullptr}};
        return state;
    }
    [[nodiscard]] static float sizeAt(double time) { return 1 + 0.6f * static_cast<float>(std::sin(6 * time)); }
    [[nodiscard]] scene::SceneState pulsating(double time) const {
        auto shape = std::make_shared<scene::DeformedMesh>(scene::DeformedMesh{*scene.solids[0].mesh, {}});
        for (glm::vec3& position : shape->mesh.positions) {
            shape->velocities.push_back(3.6f * static_cast<float>(std::cos(6 * time)) * position);
            position *= sizeAt(time);
        }
        scene::SceneState state;
        state.timeSeconds = time;
        scene::SolidPose pose;
        pose.toWorld[3] = {0.9f, 0, 0, 1};
        state.solids = {{pose, shape}};
        return state;
    }

    scene::Scene scene;
};

/// A ball of 1 m made of 6,000 particles around the origin, at rest.
struct StillShape {
    StillShape() : system(ledger, surfaceVoxels(sphereMesh(1, 16), lattice), Voxel(), 1) {
        system.grid().shareOut(6000);
        motion.birthSpeed = 0.3f;
    }
    void step(ShapeCollision& collision, const scene::SceneState& state) {
        system.live(motion, static_cast<float>(frameSeconds));
        collision.moveTo(state, frameSeconds);
        hits += collision.stopParticles(system.particles(), static_cast<float>(frameSeconds));
        collision.switchVoxels(system.grid(), {});
        system.replace({}, motion, static_cast<float>(frameSeconds));
        mostOff = std::max(mostOff, collision.switchedOff());
    }
    [[nodiscard]] std::size_t within() const {
        return static_cast<std::size_t>(std::ranges::count_if(
            system.particles().place, [](std::uint32_t place) { return (place & ShapeParticles::outside) == 0; }));
    }

    Lattice lattice = latticeAround(sphereMesh(1, 16), 24);
    MemoryLedger ledger;
    ShapeSystem system;
    Motion motion;
    std::size_t hits = 0, mostOff = 0;
};

/// Depth of the deepest particle in a ball; negative if all are outside.
float deepest(const ShapeParticles& particles, const glm::vec3& centre, float radius) {
    float depth = -INFINITY;
    for (std::size_t i = 0; i < particles.size(); ++i)
        depth = std::max(depth, radius - glm::distance(particles.store.position(i), centre));
    return depth;
}

/// The facets of sphereMesh(1, 16) come as close to the centre as this.
constexpr float innerRadius = 0.98f;

TEST(MovingCollision, NoParticleGetsIntoABallThatMovesAndTheShapeIsWholeAgainBehindIt) {
    const MovingBall ball(scene::SolidMotion::moves);
    StillShape shape;
    ShapeCollision collision(ball.scene, shape.lattice.edgeMetres, {});
    for (int step = 1; step <= 180; ++step) {
        const scene::SceneState state = MovingBall::moving(step * frameSeconds);
        shape.step(collision, state);
        const glm::vec3 centre(state.solids[0].pose.toWorld[3]);
        ASSERT_LT(deepest(shape.system.particles(), centre, 0.5f * innerRadius), 0) << step;
    }
    EXPECT_GT(shape.hits, 200u);
    EXPECT_GT(shape.mostOff, shape.system.grid().active().size() / 20);
    EXPECT_EQ(collision.switchedOff(), 0u) << "the ball has left";
    EXPECT_GT(shape.within(), 5900u);
}

TEST(MovingCollision, AShapeIsWholeAgainAfterABallThatJumpsAway) {
    const MovingBall ball(scene::SolidMotion::moves);
    StillShape shape;
    ShapeCollision collision(ball.scene, shape.lattice.edgeMetres, {});
    shape.step(collision, MovingBall::moving(1 - frameSeconds));
    scene::SceneState state = MovingBall::moving(1);
    shape.step(collision, state);
    ASSERT_GT(collision.switchedOff(), 0u);
    state.timeSeconds += frameSeconds;
    state.solids[0].pose.toWorld[3].x += 100;
    shape.step(collision, state);
    EXPECT_EQ(collision.switchedOff(), 0u);
    VoxelGrid& grid = shape.system.grid();
    for (const std::uint32_t index : grid.active()) ASSERT_TRUE(grid.voxels()[index].isOn());
}

TEST(MovingCollision, NoParticleGetsIntoABallThatDeforms) {
    const MovingBall ball(scene::SolidMotion::deforms);
    StillShape shape;
    ShapeCollision collision(ball.scene, shape.lattice.edgeMetres, {});
    std::size_t leastOff = SIZE_MAX;
    for (int step = 1; step <= 130; ++step) {
        const double time = step * frameSeconds;
        shape.step(collision, ball.pulsating(time));
        const float radius = 0.5f * innerRadius * MovingBall::sizeAt(time);
        ASSERT_LT(deepest(shape.system.particles(), {0.9f, 0, 0}, radius), 0) << step;
        leastOff = std::min(leastOff, collision.switchedOff());
    }
    EXPECT_GT(shape.hits, 200u);
    EXPECT_GT(shape.mostOff, 2 * leastOff) << "voxels follow the shape of the ball";
}

TEST(MovingCollision, ASurfaceTakesWhatRestsAlong) {
    // At rest in front of a wall with speed V: v′ = (1 + e)·V, and ahead of the wall by e·V·t after the contact.
    constexpr float speed = 3, restitution = 0.5f;
    scene::Scene scene;
    scene.solids = {{"wall", std::make_shared<scene::Mesh>(rectangleMesh({0, -1, -1}, {0, 2, 0}, {0, 0, 2})),
                     scene::SolidMotion::moves}};
    scene.solidPoses.resize(1);
    ShapeCollision collision(scene, 0.1f, {restitution, 0.2f});
    MemoryLedger ledger;
    ShapeParticles particles(ledger);
    particles.resize(1);
    particles::ParticleStore& s = particles.store;
    s.x[0] = 0.12f;
    s.y[0] = 0.3f;
    s.z[0] = -0.2f;
    s.velocityX[0] = s.velocityY[0] = s.velocityZ[0] = 0;
    std::size_t hits = 0;
    float wall = 0;
    for (int step = 1; step <= 3; ++step) {
        s.x[0] += s.velocityX[0] * static_cast<float>(frameSeconds);
        wall = speed * static_cast<float>(step * frameSeconds);
        scene::SolidPose pose;
        pose.toWorld[3].x = wall;
        pose.velocity = {speed, 0, 0};
        scene::SceneState state;
        state.solids = {{pose, nullptr}};
        collision.moveTo(state, frameSeconds);
        hits += collision.stopParticles(particles, static_cast<float>(frameSeconds));
    }
    EXPECT_EQ(hits, 1u);
    EXPECT_NEAR(s.velocityX[0], (1 + restitution) * speed, 1e-4f);
    EXPECT_NEAR(s.velocityY[0], 0, 1e-6f);
    EXPECT_GT(s.x[0], wall);
    EXPECT_LT(s.x[0], wall + 2e-3f) << "it is carried for the rest of the step";
}

TEST(MovingCollision, WhatStandsIsMetAsIfItWereStillBitForBit) {
    const auto hashOf = [](scene::SolidMotion motion) {
        MovingBall ball(motion);
        scene::SceneState state = MovingBall::moving(1.1);
        state.solids[0].pose.velocity = glm::vec3(0);
        ball.scene.solidPoses[0] = state.solids[0].pose;
        if (motion == scene::SolidMotion::still) state.solids.clear();
        StillShape shape;
        shape.motion.gravity = {0, 2, 0};
        ShapeCollision collision(ball.scene, shape.lattice.edgeMetres, {0.4f, 0.1f, 0.5f});
        for (int step = 0; step < 60; ++step) shape.step(collision, state);
        EXPECT_GT(shape.hits, 20u);
        return shape.system.stateHash();
    };
    EXPECT_EQ(hashOf(scene::SolidMotion::still), hashOf(scene::SolidMotion::moves));
}

TEST(MovingCollision, TheVehicleIsMetIfTheShapeSaysSo) {
    scene::Scene scene;
    scene.vehicle =
        scene::VehicleModel{{}, {"body", std::make_shared<scene::Mesh>(sphereMesh(0.5f, 16))}, {"wheel", nullptr}};
    const auto stateAt = [&](double time) {
        scene::SceneState state;
        state.vehicle.position = {6 * time - 5, 0.9, 0};
        state.vehicle.speed = 6;
        for (std::size_t i = 0; i < 4; ++i) {
            scene::WheelState& wheel = state.vehicle.wheels[i];
            wheel.hub = state.vehicle.position + glm::dvec3(i < 2 ? 1.2 : -1.2, -0.5, i % 2 ? 0.5 : -0.5);
            wheel.velocity = {6, 0, 0};
            wheel.spinRate = 18;
        }
        return state;
    };
    for (const bool meets : {true, false}) {
        StillShape shape;
        ShapeCollision collision(scene, shape.lattice.edgeMetres, {}, {.solids = true, .vehicle = meets});
        float depth = -INFINITY, inWheel = -INFINITY;
        for (int step = 1; step <= 150; ++step) {
            const scene::SceneState state = stateAt(step * frameSeconds);
            shape.step(collision, state);
            const ShapeParticles& particles = shape.system.particles();
            depth = std::max(depth, deepest(particles, glm::vec3(state.vehicle.position), 0.5f * innerRadius));
            // A ball within the wheel's cylinder of radius 0.33 and width 0.22.
            for (const scene::WheelState& wheel : state.vehicle.wheels)
                inWheel = std::max(inWheel, deepest(particles, glm::vec3(wheel.hub), 0.11f));
        }
        EXPECT_EQ(depth < 0, meets);
        EXPECT_EQ(inWheel < 0, meets);
        EXPECT_EQ(shape.mostOff > 50, meets);
        EXPECT_EQ(collision.switchedOff(), 0u);
    }
}

}  // namespace
}  // namespace dustbench::voxel_shape
