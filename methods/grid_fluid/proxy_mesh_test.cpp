#include "methods/grid_fluid/fluid_solids.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "methods/grid_fluid/test_bodies.h"
#include "methods/kit/meshes/mesh_file.h"

namespace dustbench::grid_fluid {
namespace {

double volumeOf(const scene::Mesh& mesh) {
    double sixth = 0;
    for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3) {
        const auto at = [&](std::size_t k) { return glm::dvec3(mesh.positions[mesh.indices[i + k]]); };
        sixth += glm::dot(at(0), glm::cross(at(1), at(2)));
    }
    return sixth / 6;
}

/// A ball whose poles are single points: those of `ball` are rings of the width of a rounding error.
scene::Mesh closedBall() {
    scene::Mesh mesh = ball(48);
    for (glm::vec3& p : mesh.positions)
        if (std::abs(p.x) < 1e-6f && std::abs(p.z) < 1e-6f) p.x = p.z = 0;
    return mesh;
}

TEST(ProxyMesh, IsCoarserStillClosedAndOfNearlyTheSameVolume) {
    const scene::Mesh fine = closedBall();
    ASSERT_EQ(meshes::openEdges(fine), 0u);
    const double whole = 4 * std::numbers::pi / 3;
    std::size_t triangles = fine.indices.size() / 3;
    for (const float edge : {0.1f, 0.2f, 0.4f}) {
        const ProxyMesh proxy(fine, edge);
        EXPECT_EQ(meshes::openEdges(proxy.mesh()), 0u) << edge;
        EXPECT_LT(proxy.mesh().indices.size() / 3, triangles / 2) << edge;
        triangles = proxy.mesh().indices.size() / 3;
        EXPECT_NEAR(volumeOf(proxy.mesh()) / whole, 1, 1.5 * static_cast<double>(edge * edge) + 0.01) << edge;
    }
}

TEST(ProxyMesh, FollowsPositionsAndVelocitiesOfAMeshThatDeforms) {
    const scene::Mesh rest = ball(24);
    ProxyMesh proxy(rest, 0.3f);
    const std::vector<glm::vec3> before = proxy.mesh().positions;
    scene::Mesh wide = rest;
    std::vector<glm::vec3> velocities;
    for (glm::vec3& position : wide.positions) {
        velocities.push_back(2.0f * position);
        position *= 1.5f;
    }
    proxy.follow(wide, velocities);
    ASSERT_EQ(proxy.velocities().size(), before.size());
    for (std::size_t v = 0; v < before.size(); ++v) {
        ASSERT_LT(glm::distance(proxy.mesh().positions[v], 1.5f * before[v]), 1e-5f);
        ASSERT_LT(glm::distance(proxy.velocities()[v], 2.0f * before[v]), 1e-5f);
    }
}

TEST(ProxyMesh, IsVoxelisedAsTheMeshExceptNextToItsSurface) {
    constexpr glm::ivec3 grid{40, 40, 40};
    scene::Scene scene;
    scene.solids = {{"ball", std::make_shared<scene::Mesh>(ball(48)), scene::SolidMotion::moves}};
    scene.solidPoses = {{glm::mat4(placed({2, 2, 2}, 1.3)), {}, {}}};
    const flow::FluidBox box{grid, 0.1, {0, 0, 0}};
    MemoryLedger ledger;
    FluidSolids exact(scene, grid, ledger.account("exact")), proxy(scene, grid, ledger.account("proxy"), nullptr, 2);
    static_cast<void>(exact.voxelise(box, {}));
    static_cast<void>(proxy.voxelise(box, {}));
    std::size_t differ = 0, solid = 0, n = 0;
    for (int k = 0; k < grid.z; ++k)
        for (int j = 0; j < grid.y; ++j)
            for (int i = 0; i < grid.x; ++i, ++n) {
                const double depth = 13 - glm::distance(glm::dvec3(i, j, k) + 0.5, glm::dvec3(20));  // in cells
                solid += exact.bodies()[n] != 0 ? 1 : 0;
                if ((exact.bodies()[n] != 0) == (proxy.bodies()[n] != 0)) continue;
                ++differ;
                ASSERT_LT(std::abs(depth), 1.5) << i << ' ' << j << ' ' << k;
            }
    EXPECT_GT(solid, 9000u);
    EXPECT_GT(differ, 0u) << "it is coarser";
    EXPECT_LT(differ, solid / 10);
}

}  // namespace
}  // namespace dustbench::grid_fluid
