#include "methods/kit/draw/shadow_footprint.h"

#include <gtest/gtest.h>

#include "methods/kit/draw/opaque_test_scene.h"

namespace dustbench::draw {
namespace {

TEST(ShadowFootprint, OfABoxOnLevelGroundIsItsProjectionAlongTheSun) {
    const glm::vec3 toSun = glm::normalize(glm::vec3(1, 2, 0));
    const GroundRectangle got = shadowFootprint({-1, 0, -2}, {1, 4, 2}, glm::dmat4(1), toSun, {}, 0.5);
    EXPECT_NEAR(got.minimum.x, -1 - 4 * 0.5 - 0.5, 1e-6);
    EXPECT_NEAR(got.maximum.x, 1.5, 1e-6);
    EXPECT_NEAR(got.minimum.y, -2.5, 1e-6);
    EXPECT_NEAR(got.maximum.y, 2.5, 1e-6);
}

TEST(ShadowFootprint, StaysFiniteWhenTheSunIsDown) {
    const GroundRectangle got =
        shadowFootprint({-1, 0, -1}, {1, 1, 1}, glm::dmat4(1), glm::normalize(glm::vec3(1, -0.5f, 0)), {}, 0);
    EXPECT_GT(got.minimum.x, -12);
    EXPECT_LE(got.minimum.x, -1);
}

TEST(ShadowFootprints, AreOnePerGroupOfThingsAndDoNotOverlap) {
    scene::Mesh row;
    for (int n = 0; n < 20; ++n)
        row.append(
            test::box({25.0f * static_cast<float>(n), 0, 0}, {25.0f * static_cast<float>(n) + 1, 2, 1}, {1, 1, 1}),
            glm::mat4(1));
    const auto got = shadowFootprints(row, glm::dmat4(1), glm::normalize(glm::vec3(1, 1, 1)), {}, 0.3);
    ASSERT_EQ(got.size(), 20u);
    for (const GroundRectangle& rectangle : got) EXPECT_LT(rectangle.maximum.x - rectangle.minimum.x, 4);
}

TEST(JoinOverlapping, LeavesNoOverlapAndLosesNoGround) {
    std::vector<GroundRectangle> rectangles{
        {{0, 0}, {1, 1}}, {{4, 4}, {5, 5}}, {{0.5, 0.5}, {4.5, 4.5}}, {{9, 0}, {10, 1}}};
    joinOverlapping(rectangles);
    ASSERT_EQ(rectangles.size(), 2u);
    EXPECT_EQ(rectangles[0].minimum, glm::dvec2(0, 0));
    EXPECT_EQ(rectangles[0].maximum, glm::dvec2(5, 5));
    EXPECT_EQ(rectangles[1].minimum, glm::dvec2(9, 0));
}

}  // namespace
}  // namespace dustbench::draw
