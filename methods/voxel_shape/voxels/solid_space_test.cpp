#include "methods/voxel_shape/voxels/solid_space.h"

#include <gtest/gtest.h>

#include <glm/gtc/matrix_transform.hpp>
#include <memory>
#include <random>

namespace dustbench::voxel_shape {
namespace {

/// A cube of edge 2 around the origin, counter-clockwise as seen from outside.
scene::Mesh cube() {
    scene::Mesh mesh;
    for (int corner = 0; corner < 8; ++corner)
        mesh.positions.emplace_back(corner & 4 ? 1 : -1, corner & 2 ? 1 : -1, corner & 1 ? 1 : -1);
    mesh.indices = {0, 1, 3, 0, 3, 2, 4, 6, 7, 4, 7, 5, 0, 4, 5, 0, 5, 1,
                    2, 3, 7, 2, 7, 6, 0, 2, 6, 0, 6, 4, 1, 5, 7, 1, 7, 3};
    return mesh;
}

TEST(SolidSpace, IsWhatLiesWithinASolidWhereverItStands) {
    scene::Scene scene;
    scene::SolidPose pose;
    pose.toWorld = glm::rotate(glm::translate(glm::mat4(1), {5, 1, 0}), 0.6f, {0.6f, 0.8f, 0});
    scene.solids = {{"here", std::make_shared<scene::Mesh>(cube())}, {"there", std::make_shared<scene::Mesh>(cube())}};
    scene.solidPoses = {scene::SolidPose(), pose};
    const SolidSpace space(scene);
    const glm::dmat4 toThere = glm::inverse(glm::dmat4(pose.toWorld));
    std::mt19937_64 random(3);
    std::uniform_real_distribution<double> along(-2.5, 8);
    int within = 0;
    for (int i = 0; i < 20'000; ++i) {
        const glm::dvec3 point(along(random), along(random) / 2, along(random) / 2);
        const auto inCube = [](const glm::dvec3& p) { return glm::all(glm::lessThan(glm::abs(p), glm::dvec3(1))); };
        const bool expected = inCube(point) || inCube(glm::dvec3(toThere * glm::dvec4(point, 1)));
        ASSERT_EQ(space.contains(point), expected) << point.x << ' ' << point.y << ' ' << point.z;
        within += expected;
    }
    EXPECT_GT(within, 500);
}

}  // namespace
}  // namespace dustbench::voxel_shape
