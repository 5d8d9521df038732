#include "methods/contract/terrain.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <stdexcept>

namespace dustbench::scene {
namespace {

Terrain bumpy() {
    std::mt19937 random(7);
    std::vector<float> heights(5 * 4);
    for (float& height : heights) height = static_cast<float>(random() % 1000) / 250.0f;
    return {heights, 5, 4, 2.0f, -3.0f, 1.0f};
}

TEST(Terrain, IsThePlaneZeroByDefault) {
    const Terrain terrain;
    EXPECT_TRUE(terrain.isFlat());
    EXPECT_EQ(terrain.heightAt(1e4f, -1e4f), 0);
    EXPECT_EQ(terrain.normalAt(3, 4), glm::vec3(0, 1, 0));
}

TEST(Terrain, GivesTheSamplesAtTheirPlaces) {
    const Terrain terrain = bumpy();
    for (int j = 0; j < 4; ++j)
        for (int i = 0; i < 5; ++i)
            EXPECT_FLOAT_EQ(terrain.heightAt(-3 + 2.0f * static_cast<float>(i), 1 + 2.0f * static_cast<float>(j)),
                            terrain.heights()[static_cast<std::size_t>(j * 5 + i)]);
}

TEST(Terrain, EqualsTheBilinearFormBetweenSamples) {
    const Terrain terrain = bumpy();
    const auto h = [&](int i, int j) { return terrain.heights()[static_cast<std::size_t>(j * 5 + i)]; };
    std::mt19937 random(3);
    std::uniform_real_distribution<float> share(0, 1);
    for (int n = 0; n < 1000; ++n) {
        const int i = static_cast<int>(random() % 4), j = static_cast<int>(random() % 3);
        const float u = share(random), v = share(random);
        const float expected = h(i, j) * (1 - u) * (1 - v) + h(i + 1, j) * u * (1 - v) + h(i, j + 1) * (1 - u) * v +
                               h(i + 1, j + 1) * u * v;
        EXPECT_NEAR(terrain.heightAt(-3 + 2 * (static_cast<float>(i) + u), 1 + 2 * (static_cast<float>(j) + v)),
                    expected, 1e-4f);
    }
}

TEST(Terrain, HasNormalsAcrossItsSlopes) {
    const Terrain terrain = bumpy();
    std::mt19937 random(5);
    std::uniform_real_distribution<float> share(0.05f, 0.95f);
    constexpr float step = 0.01f;
    for (int n = 0; n < 300; ++n) {
        const float x = -3 + 2 * (static_cast<float>(random() % 4) + share(random));
        const float z = 1 + 2 * (static_cast<float>(random() % 3) + share(random));
        const glm::vec3 normal = terrain.normalAt(x, z);
        EXPECT_NEAR(glm::length(normal), 1, 1e-6);
        const float slopeX = (terrain.heightAt(x + step, z) - terrain.heightAt(x - step, z)) / (2 * step);
        const float slopeZ = (terrain.heightAt(x, z + step) - terrain.heightAt(x, z - step)) / (2 * step);
        EXPECT_NEAR(normal.x / normal.y, -slopeX, 2e-3);
        EXPECT_NEAR(normal.z / normal.y, -slopeZ, 2e-3);
    }
}

TEST(Terrain, CarriesItsEdgeOnOutside) {
    const Terrain terrain = bumpy();
    EXPECT_EQ(terrain.heightAt(-100, 3), terrain.heightAt(-3, 3));
    EXPECT_EQ(terrain.heightAt(100, 3), terrain.heightAt(5, 3));
    EXPECT_EQ(terrain.heightAt(0.5f, 1e6f), terrain.heightAt(0.5f, 7));
    EXPECT_EQ(terrain.normalAt(-100, 3).x, 0);
    EXPECT_EQ(terrain.normalAt(100, -100), glm::vec3(0, 1, 0));
}

TEST(Terrain, RefusesAWrongNumberOfHeights) {
    EXPECT_THROW(Terrain({1, 2, 3}, 2, 2, 1, 0, 0), std::invalid_argument);
    EXPECT_THROW(Terrain({1, 2, 3}, 3, 1, 1, 0, 0), std::invalid_argument);
    EXPECT_THROW(Terrain({1, 2, 3, 4}, 2, 2, 0, 0, 0), std::invalid_argument);
    EXPECT_THROW(Terrain({1, 2, 3, 4}, 2, 2, NAN, 0, 0), std::invalid_argument);
}

}  // namespace
}  // namespace dustbench::scene
