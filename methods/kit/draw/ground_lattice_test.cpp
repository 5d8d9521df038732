#include "methods/kit/draw/ground_lattice.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <map>
#include <random>
#include <set>
#include <tuple>

#include "methods/kit/draw/opaque_test_scene.h"

namespace dustbench::draw {
namespace {

using Point = std::tuple<float, float, float>;
using Triangle = std::array<std::uint32_t, 3>;

Point pointOf(const GroundVertex& vertex) {
    return {vertex.position.x, vertex.position.y, vertex.position.z};
}

std::vector<std::uint32_t> everything(const GroundLattice& lattice) {
    std::vector<std::uint32_t> indices;
    const GroundRectangle all{glm::dvec2(-1e9), glm::dvec2(1e9)};
    lattice.appendWithin(std::span(&all, 1), indices);
    return indices;
}

std::set<Triangle> trianglesOf(const std::vector<std::uint32_t>& indices) {
    std::set<Triangle> result;
    for (std::size_t i = 0; i < indices.size(); i += 3) result.insert({indices[i], indices[i + 1], indices[i + 2]});
    return result;
}

/// Every directed edge, except on the outermost rim, has exactly one opposite edge.
void expectNoHoles(const GroundLattice& lattice) {
    const auto vertices = lattice.vertices();
    const std::vector<std::uint32_t> indices = everything(lattice);
    std::map<std::pair<Point, Point>, int> edges;
    float minimum = 0;
    for (std::size_t i = 0; i < indices.size(); i += 3)
        for (std::size_t k = 0; k < 3; ++k) {
            const GroundVertex &a = vertices[indices[i + k]], &b = vertices[indices[i + (k + 1) % 3]];
            ++edges[{pointOf(a), pointOf(b)}];
            minimum = std::min(minimum, a.position.x);
        }
    int open = 0;
    for (const auto& [edge, count] : edges) {
        ASSERT_EQ(count, 1);
        if (edges.contains({edge.second, edge.first})) continue;
        ++open;
        for (const Point& point : {edge.first, edge.second})
            ASSERT_GT(std::max(std::abs(std::get<0>(point)), std::abs(std::get<2>(point))), 20e3f);
    }
    EXPECT_GT(open, 0);
    EXPECT_LT(minimum, -20e3f);
}

TEST(GroundLattice, HasNoHolesBetweenItsRings) {
    const scene::Terrain flat, dunes = test::dunes(65, 3.0f);
    for (const scene::Terrain* terrain : {&flat, &dunes}) {
        GroundLattice lattice(*terrain);
        for (const glm::dvec3& eye : {glm::dvec3(0, 2, 0), glm::dvec3(1234.5, 3, -777.25), glm::dvec3(9999, 2, 5)}) {
            lattice.moveTo(eye);
            expectNoHoles(lattice);
        }
    }
}

TEST(GroundLattice, LiesOnTheTerrainAndFacesUp) {
    const scene::Terrain terrain = test::dunes(65, 3.0f);
    GroundLattice lattice(terrain);
    lattice.moveTo({17, 5, -23});
    for (const GroundVertex& vertex : lattice.vertices()) {
        const glm::dvec3 world = lattice.anchor() + glm::dvec3(vertex.position);
        EXPECT_EQ(vertex.position.y, terrain.heightAt(static_cast<float>(world.x), static_cast<float>(world.z)));
        EXPECT_GT(vertex.normal.y, 0.3f);
        EXPECT_NEAR(glm::length(vertex.normal), 1, 1e-5f);
    }
    const auto indices = everything(lattice);
    for (std::size_t i = 0; i < indices.size(); i += 3) {
        const glm::vec3 a = lattice.vertices()[indices[i]].position;
        const glm::vec3 b = lattice.vertices()[indices[i + 1]].position;
        const glm::vec3 c = lattice.vertices()[indices[i + 2]].position;
        EXPECT_GT(glm::cross(b - a, c - a).y, 0);
    }
}

TEST(GroundLattice, IsRenewedOnlyWhenTheEyeLeavesItsCell) {
    const scene::Terrain terrain = test::dunes(65, 3.0f);
    GroundLattice lattice(terrain);
    EXPECT_TRUE(lattice.moveTo({0, 5, 0}));
    EXPECT_FALSE(lattice.moveTo({0, 50, 0}));
    int renewed = 0;
    for (int step = 1; step <= 100; ++step) renewed += lattice.moveTo({0.1 * step, 5, 0}) ? 1 : 0;
    EXPECT_GE(renewed, 1);
    EXPECT_LE(renewed, 3);
}

TEST(GroundLattice, KeepsEveryTriangleThatMayBeSeen) {
    const scene::Terrain terrain = test::dunes(65, 3.0f);
    GroundLattice lattice(terrain);
    std::mt19937 engine(3);
    std::uniform_real_distribution<double> share(-1, 1);
    for (int n = 0; n < 12; ++n) {
        const glm::dvec3 eye(100 * share(engine), 9 + 3 * share(engine), 100 * share(engine));
        lattice.moveTo(eye);
        const glm::dvec3 ahead(share(engine), 0.5 * share(engine), share(engine));
        const scene::View view = test::viewFrom(eye - lattice.anchor(), eye - lattice.anchor() + ahead);
        std::vector<std::uint32_t> indices;
        lattice.appendVisible(view.worldToClip(), indices);
        EXPECT_LT(indices.size(), everything(lattice).size());
        const auto kept = trianglesOf(indices);
        for (const Triangle& triangle : trianglesOf(everything(lattice)))
            for (const std::uint32_t index : triangle) {
                const glm::vec4 clip = view.worldToClip() * glm::vec4(lattice.vertices()[index].position, 1);
                const bool seen = std::abs(clip.x) < clip.w && std::abs(clip.y) < clip.w && clip.z < clip.w;
                EXPECT_TRUE(!seen || kept.contains(triangle));
            }
    }
}

TEST(GroundLattice, FindsEveryTriangleOverRectanglesOnce) {
    const scene::Terrain terrain = test::dunes(65, 3.0f);
    GroundLattice lattice(terrain);
    lattice.moveTo({500, 2, 300});
    const GroundRectangle rectangle{{503.2, 297.7}, {507.9, 301.3}};
    const std::array<GroundRectangle, 2> twice{rectangle, rectangle};
    std::vector<std::uint32_t> indices;
    lattice.appendWithin(twice, indices);
    const auto kept = trianglesOf(indices);
    EXPECT_EQ(kept.size(), indices.size() / 3);  // each once
    EXPECT_LT(kept.size(), 200u);
    for (const Triangle& triangle : trianglesOf(everything(lattice))) {
        glm::dvec3 centre(0);
        for (const std::uint32_t index : triangle)
            centre += (lattice.anchor() + glm::dvec3(lattice.vertices()[index].position)) / 3.0;
        const bool within = centre.x > rectangle.minimum.x && centre.x < rectangle.maximum.x &&
                            centre.z > rectangle.minimum.y && centre.z < rectangle.maximum.y;
        EXPECT_TRUE(!within || kept.contains(triangle));
    }
}

}  // namespace
}  // namespace dustbench::draw
