#include "methods/kit/meshes/triangle_tree.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace dustbench::meshes {
namespace {

TEST(TriangleTree, FindsTheNearestPointOfAllTriangles) {
    // Against 60 x 60 samples of each of 40 random triangles.
    std::mt19937 random(3);
    std::uniform_real_distribution<float> place(-1, 1);
    const auto point = [&] { return glm::vec3(place(random), place(random), place(random)); };
    scene::Mesh mesh;
    for (std::uint32_t i = 0; i < 120; ++i) {
        const glm::vec3 corner = i % 3 == 0 ? 2.0f * point() : mesh.positions.back() + 0.7f * point();
        mesh.positions.push_back(corner);
        mesh.indices.push_back(i);
    }
    TriangleTree tree;
    tree.add(mesh, glm::mat4(1));
    tree.build();
    constexpr int samples = 60;
    for (int n = 0; n < 100; ++n) {
        const glm::vec3 from = 2.5f * point();
        double sampled = INFINITY;
        for (std::size_t t = 0; t < 120; t += 3)
            for (int i = 0; i <= samples; ++i)
                for (int j = 0; i + j <= samples; ++j) {
                    const double a = static_cast<double>(i) / samples, b = static_cast<double>(j) / samples;
                    const glm::dvec3 at = a * glm::dvec3(mesh.positions[t]) + b * glm::dvec3(mesh.positions[t + 1]) +
                                          (1 - a - b) * glm::dvec3(mesh.positions[t + 2]);
                    sampled = std::min(sampled, glm::distance(at, glm::dvec3(from)));
                }
        const auto nearest = tree.nearest(from, 10);
        ASSERT_TRUE(nearest);
        EXPECT_LE(nearest->distanceMetres, sampled + 1e-9);
        EXPECT_GE(nearest->distanceMetres, sampled - 2.0 / samples);
        glm::dvec3 at(0);
        for (std::size_t k = 0; k < 3; ++k)
            at += nearest->weights[static_cast<int>(k)] * glm::dvec3(mesh.positions[3 * nearest->triangle + k]);
        EXPECT_NEAR(glm::distance(at, glm::dvec3(from)), nearest->distanceMetres, 1e-9);
        EXPECT_FALSE(tree.nearest(from, static_cast<float>(0.99 * nearest->distanceMetres)));
        EXPECT_TRUE(tree.nearest(from, static_cast<float>(1.01 * nearest->distanceMetres)));
    }
}

}  // namespace
}  // namespace dustbench::meshes
