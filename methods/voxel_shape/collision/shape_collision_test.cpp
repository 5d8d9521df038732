#include "methods/voxel_shape/collision/shape_collision.h"

#include <gtest/gtest.h>
#include <tbb/task_arena.h>

#include <glm/gtc/matrix_transform.hpp>
#include <random>

#include "methods/kit/meshes/mesh_file.h"
#include "methods/kit/meshes/triangle_tree.h"
#include "methods/voxel_shape/collision/solid_places.h"
#include "methods/voxel_shape/particles/shape_system.h"
#include "methods/voxel_shape/voxels/surface_voxels.h"
#include "methods/voxel_shape/voxels/test_meshes.h"

namespace dustbench::voxel_shape {
namespace {

constexpr float dt = 1.0f / 60;

/// Returns a closed box around the origin.
scene::Mesh boxMesh(const glm::vec3& half) {
    scene::Mesh mesh;
    for (int corner = 0; corner < 8; ++corner) {
        mesh.positions.push_back(half * glm::vec3(corner & 1 ? 1 : -1, corner & 2 ? 1 : -1, corner & 4 ? 1 : -1));
        mesh.colours.emplace_back(0.5f);
    }
    mesh.indices = {0, 4, 6, 0, 6, 2, 1, 3, 7, 1, 7, 5, 0, 1, 5, 0, 5, 4,
                    2, 6, 7, 2, 7, 3, 0, 2, 3, 0, 3, 1, 4, 5, 7, 4, 7, 6};
    return mesh;
}

scene::Scene sceneWith(const scene::Mesh& mesh, const glm::mat4& toWorld) {
    scene::Scene scene;
    scene.solids.push_back({"solid", std::make_shared<scene::Mesh>(mesh)});
    scene.solidPoses.push_back({toWorld, {}, {}});
    return scene;
}

TEST(TriangleTree, FindsTheFirstTriangleOfASegmentAsAPlainLoopDoes) {
    const scene::Mesh sphere = sphereMesh(1, 20);
    meshes::TriangleTree tree;
    tree.add(sphere, glm::translate(glm::mat4(1), {10, 0, 0}));
    tree.build();
    std::mt19937 random(1);
    std::uniform_real_distribution<float> unit(-1.6f, 1.6f);
    int met = 0;
    for (int sample = 0; sample < 300; ++sample) {
        const glm::vec3 from(10 + unit(random), unit(random), unit(random)),
            to(10 + unit(random), unit(random), unit(random));
        double nearest = 2;
        for (std::size_t i = 0; i < sphere.indices.size(); i += 3) {
            const auto corner = [&](std::size_t k) {
                return glm::dvec3(sphere.positions[sphere.indices[i + k]]) + glm::dvec3(10, 0, 0);
            };
            const glm::dvec3 a = corner(0), e = corner(1) - a, f = corner(2) - a, d = glm::dvec3(to) - glm::dvec3(from);
            const glm::dvec3 p = glm::cross(d, f), s = glm::dvec3(from) - a, q = glm::cross(s, e);
            const double det = glm::dot(e, p);
            if (det == 0) continue;
            const double u = glm::dot(s, p) / det, v = glm::dot(d, q) / det, t = glm::dot(f, q) / det;
            if (u >= 0 && v >= 0 && u + v <= 1 && t >= 0 && t <= 1) nearest = std::min(nearest, t);
        }
        const auto hit = tree.firstHit(from, to);
        ASSERT_EQ(hit.has_value(), nearest <= 1) << sample;
        if (!hit) continue;
        ++met;
        ASSERT_NEAR(static_cast<double>(hit->share), nearest, 1e-4);
        ASSERT_LE(glm::dot(hit->normal, to - from), 0);
    }
    EXPECT_GT(met, 80);
    EXPECT_GT(tree.bytes(), tree.triangles() * 36);
}

TEST(MeshParts, AreWhatHangsTogetherOrOverlaps) {
    scene::Mesh mesh;
    const auto add = [&](const glm::vec3& at, const glm::vec3& half) {
        const scene::Mesh box = boxMesh(half);
        const auto first = static_cast<std::uint32_t>(mesh.positions.size());
        for (const glm::vec3& position : box.positions) mesh.positions.push_back(at + position);
        for (const std::uint32_t index : box.indices) mesh.indices.push_back(first + index);
    };
    add({0, 0, 0}, {1, 1, 1});
    add({10, 0, 0}, {1, 1, 1});
    add({0.5f, 1.5f, 0}, {0.2f, 1, 0.2f});  // overlaps the first
    add({10, 0, 5}, {1, 1, 1});
    const std::vector<scene::Mesh> parts = partsOf(mesh);
    ASSERT_EQ(parts.size(), 3u);
    EXPECT_EQ(parts[0].indices.size(), 72u);
    EXPECT_EQ(parts[1].indices.size(), 36u);
    EXPECT_EQ(meshes::openEdges(parts[2]), 0u);
}

TEST(ShapeCollision, LeavesVoxelsOnBetweenTheCopiesOfASolid) {
    const scene::Mesh ball = sphereMesh(1, 16);
    const Lattice lattice = latticeAround(ball, 24);
    MemoryLedger ledger;
    ShapeSystem system(ledger, surfaceVoxels(ball, lattice), Voxel(), 1);
    scene::Mesh copies = sphereMesh(1, 12);
    copies.normals.assign(copies.positions.size(), glm::vec3(0, 1, 0));
    const scene::Mesh one = copies;
    for (int k = 1; k < 20; ++k)
        copies.append(one, glm::translate(glm::mat4(1), {50.0f * static_cast<float>(k), 0, 0}));
    const scene::Scene scene = sceneWith(copies, glm::mat4(1));
    ShapeCollision collision(scene, lattice.edgeMetres, {});
    collision.moveTo({}, static_cast<double>(dt));
    Pose pose;
    pose.position = {102.5f, 0, 0};
    collision.switchVoxels(system.grid(), pose);
    EXPECT_EQ(collision.switchedOff(), 0u);
    pose.position = {101, 0, 0};
    collision.switchVoxels(system.grid(), pose);
    EXPECT_GT(collision.switchedOff(), 100u);
}

TEST(ShapeCollision, SwitchesOffEveryVoxelThatTouchesASolidAndOnAgainAfterwards) {
    const scene::Mesh ball = sphereMesh(1, 16);
    const Lattice lattice = latticeAround(ball, 24);
    MemoryLedger ledger;
    ShapeSystem system(ledger, surfaceVoxels(ball, lattice), Voxel(), 1);
    const glm::vec3 half(0.3f, 5, 0.2f);
    const glm::mat4 turned = glm::rotate(glm::translate(glm::mat4(1), {3, 0, 0}), 0.5f, {0, 1, 0});
    const scene::Scene scene = sceneWith(boxMesh(half), turned);
    ShapeCollision collision(scene, lattice.edgeMetres, {});
    collision.moveTo({}, static_cast<double>(dt));
    for (const float x : {0.0f, 2.5f, 3.0f, 3.6f, 8.0f}) {
        Pose pose;
        pose.position = {x, 0, 0};
        collision.switchVoxels(system.grid(), pose);
        std::size_t off = 0;
        for (const std::uint32_t i : system.grid().active()) {
            const Voxel& voxel = system.grid().voxels()[i];
            off += !voxel.isOn();
            const glm::vec3 centre(glm::inverse(turned) * glm::vec4(pose.toWorld(lattice.centre(lattice.cell(i))), 1));
            // Distance from the box: voxels closer than half an edge overlap it; distant ones stay on.
            const float away = glm::length(glm::max(glm::abs(centre) - half, glm::vec3(0)));
            ASSERT_FALSE(away < lattice.edgeMetres / 2 && voxel.isOn());
            ASSERT_FALSE(away > 2.6f * lattice.edgeMetres && !voxel.isOn());
        }
        EXPECT_EQ(off, collision.switchedOff());
        EXPECT_EQ(off > 0, x > 1 && x < 5) << x;
    }
}

/// Moves a ball of particles through a wall; returns the hash of the final state.
std::uint64_t throughAWall(bool check) {
    const scene::Mesh ball = sphereMesh(1, 16);
    const Lattice lattice = latticeAround(ball, 24);
    MemoryLedger ledger;
    ShapeSystem system(ledger, surfaceVoxels(ball, lattice), Voxel(), 1);
    system.grid().shareOut(6000);
    const glm::vec3 half(0.4f, 4, 1.2f);
    // The corner of a wall: half of the ball passes it.
    const scene::Scene scene = sceneWith(boxMesh(half), glm::translate(glm::mat4(1), {4, 0, 1.2f}));
    ShapeCollision collision(scene, lattice.edgeMetres, {});
    collision.moveTo({}, static_cast<double>(dt));
    Motion motion;
    motion.birthSpeed = 0.3f;
    std::size_t hits = 0, maximumOff = 0, maximumOutside = 0;
    for (int step = 0; step < 120; ++step) {
        Pose pose;
        pose.velocity = {4, 0, 0};
        pose.position = pose.velocity * (dt * static_cast<float>(step));
        system.live(motion, dt);
        hits += collision.stopParticles(system.particles(), dt);
        collision.switchVoxels(system.grid(), pose);
        system.replace(pose, motion, dt);
        std::size_t within = 0;
        for (std::size_t i = 0; check && i < system.particles().size(); ++i) {
            const glm::vec3 place = system.particles().store.position(i) - glm::vec3(4, 0, 1.2f);
            EXPECT_TRUE(glm::any(glm::greaterThan(glm::abs(place), half - 1e-4f)))
                << step << ": " << system.particles().store.serial[i];
            within += (system.particles().place[i] & ShapeParticles::outside) == 0;
        }
        maximumOff = std::max(maximumOff, collision.switchedOff());
        maximumOutside = std::max(maximumOutside, system.particles().size() - within);
    }
    if (check) {
        std::size_t within = 0;
        for (const std::uint32_t place : system.particles().place) within += (place & ShapeParticles::outside) == 0;
        EXPECT_GT(hits, 500u);
        EXPECT_GT(maximumOff, system.grid().active().size() / 10) << "it burst";
        EXPECT_GT(maximumOutside, 1000u);
        EXPECT_GT(within, 5900u) << "and is whole again";
        EXPECT_LE(within, 6000u);
        EXPECT_EQ(collision.switchedOff(), 0u);
    }
    return system.stateHash();
}

TEST(ShapeCollision, LetsNoParticleIntoAWallAndTheShapeIsWholeAgainBehindIt) {
    (void)throughAWall(true);
}

TEST(ShapeCollision, IsTheSameAtAnyNumberOfThreads) {
    const auto at = [](int threads) {
        tbb::task_arena arena(threads);
        std::uint64_t hash = 0;
        arena.execute([&] { hash = throughAWall(false); });
        return hash;
    };
    EXPECT_EQ(at(1), at(3));
}

TEST(ShapeCollision, TurnsBackWhatLedIntoTheSurfaceAndSlowsWhatLedAlongIt) {
    MemoryLedger ledger;
    ShapeParticles particles(ledger);
    particles.resize(1);
    const scene::Scene scene = sceneWith(boxMesh({1, 1, 1}), glm::mat4(1));
    ShapeCollision collision(scene, 0.1f, {0.5f, 0.2f});
    collision.moveTo({}, static_cast<double>(dt));
    particles::ParticleStore& s = particles.store;
    // The particle has just moved from (−1.05, 0, 0) by (0.1, 0.05, 0) into the side x = −1.
    s.x[0] = -0.95f;
    s.y[0] = 0.05f;
    s.z[0] = 0;
    s.velocityX[0] = 6;
    s.velocityY[0] = 3;
    s.velocityZ[0] = 0;
    EXPECT_EQ(collision.stopParticles(particles, dt), 1u);
    EXPECT_NEAR(s.x[0], -1, 2e-3f);
    EXPECT_LT(s.x[0], -1);
    EXPECT_NEAR(s.velocityX[0], -3, 1e-4f);
    EXPECT_NEAR(s.velocityY[0], 2.4f, 1e-4f);
}

TEST(ShapeCollision, ScattersAlongTheSurfaceAloneAndAllWaysAlike) {
    MemoryLedger ledger;
    ShapeParticles particles(ledger);
    constexpr std::size_t count = 2000;
    particles.resize(count);
    const scene::Scene scene = sceneWith(boxMesh({1, 1, 1}), glm::mat4(1));
    ShapeCollision collision(scene, 0.1f, {0.6f, 0, 0.8f});
    collision.moveTo({}, static_cast<double>(dt));
    particles::ParticleStore& s = particles.store;
    for (std::size_t i = 0; i < count; ++i) {
        s.serial[i] = i;
        s.x[i] = -0.95f;
        s.y[i] = s.z[i] = 0;
        s.velocityX[i] = 6;
        s.velocityY[i] = s.velocityZ[i] = 0;
    }
    EXPECT_EQ(collision.stopParticles(particles, dt), count);
    glm::dvec2 sum(0), squares(0);
    for (std::size_t i = 0; i < count; ++i) {
        ASSERT_NEAR(s.velocityX[i], -3.6f, 1e-4f);
        const glm::dvec2 along(s.velocityY[i], s.velocityZ[i]);
        ASSERT_LE(glm::length(along), 4.8 + 1e-4) << "no energy is gained";
        sum += along;
        squares += along * along;
    }
    // Uniform on a disc of radius R: mean 0, variance R²/4 along each axis, 5.76 here.
    EXPECT_LT(glm::length(sum) / count, 4 * std::sqrt(2 * 5.76 / count));
    EXPECT_NEAR(squares.x / count, 5.76, 0.5);
    EXPECT_NEAR(squares.y / count, 5.76, 0.5);
}

}  // namespace
}  // namespace dustbench::voxel_shape
