// Tests pictures of moving solids: the same as those of fixed solids at the current positions, with their shadows.
#include "methods/kit/draw/placed_solids.h"

#include <gtest/gtest.h>

#include <glm/gtc/matrix_transform.hpp>

#include "methods/kit/draw/opaque_scene.h"
#include "methods/kit/draw/opaque_test_scene.h"
#include "methods/kit/draw/read_back.h"
#include "methods/kit/draw/test_canvas.h"

namespace dustbench::draw {
namespace {

glm::mat4 poseAt(float time) {
    return glm::rotate(glm::translate(glm::mat4(1), {2 * time, 0.3f, -time}), time, {0, 1, 0});
}

/// The box grows wider and lower over time.
std::shared_ptr<const scene::DeformedMesh> shapeAt(const scene::Mesh& rest, float time) {
    auto shape = std::make_shared<scene::DeformedMesh>(scene::DeformedMesh{rest, {}});
    for (glm::vec3& position : shape->mesh.positions) position *= glm::vec3(1 + time, 1 - 0.3f * time, 1);
    shape->velocities.resize(rest.positions.size());
    return shape;
}

TEST(PlacedSolids, AreSeenAndThrowShadowsWhereTheyAreAtTheMoment) {
    const scene::View view = test::viewFrom({5, 4, 9}, {1, 0.5, 0}, 200, 150);
    for (const scene::SolidMotion motion : {scene::SolidMotion::moves, scene::SolidMotion::deforms}) {
        scene::Scene scene = test::underAHighSun();
        scene.solids = {test::boxSolid({-3, 0, -1}, {-2, 1, 1}, {0.2f, 0.7f, 0.2f}),
                        test::boxSolid({-0.5f, 0, -0.5f}, {0.5f, 1.5f, 0.5f}, {0.9f, 0.1f, 0.9f})};
        scene.solids[1].motion = motion;
        scene.solidPoses.resize(2);
        OpaqueScene moving(scene, TestCanvas::device(), view.width, view.height);
        std::vector<glm::vec4> last;
        for (const float time : {0.0f, 0.4f, 0.4f, 0.9f, 0.1f}) {
            scene::SceneState state;
            state.solids = {{scene.solidPoses[0], nullptr}, {{poseAt(time), {}, {}}, nullptr}};
            scene::Scene there = scene;
            there.solids[1].motion = scene::SolidMotion::still;
            there.solidPoses[1].toWorld = poseAt(time);
            if (motion == scene::SolidMotion::deforms) {
                state.solids[1].shape = shapeAt(*scene.solids[1].mesh, time);
                there.solids[1].mesh = std::make_shared<scene::Mesh>(state.solids[1].shape->mesh);
            }
            moving.draw(state, view);
            const auto seen = readBack(moving.colour()).pixels;
            OpaqueScene still(there, TestCanvas::device(), view.width, view.height);
            still.draw({}, view);
            EXPECT_EQ(seen, readBack(still.colour()).pixels) << time;
            if (!last.empty() && time != 0.4f) {
                EXPECT_NE(seen, last) << time;
            }
            last = seen;
        }
    }
}

TEST(PlacedSolids, SayWhetherAnythingHasMoved) {
    scene::Scene scene = test::underAHighSun();
    scene.solids = {test::boxSolid({-0.5f, 0, -0.5f}, {0.5f, 1.5f, 0.5f}, {0.9f, 0.1f, 0.9f})};
    scene.solids[0].motion = scene::SolidMotion::moves;
    scene.solidPoses.resize(1);
    PlacedSolids placed(scene, TestCanvas::device());
    scene::SceneState state;
    EXPECT_FALSE(placed.moveTo(state));
    state.solids = {{{poseAt(1), {}, {}}, nullptr}};
    EXPECT_TRUE(placed.moveTo(state));
    EXPECT_FALSE(placed.moveTo(state));
    EXPECT_EQ(glm::vec3(placed.all()[0].toWorld[3]), glm::vec3(2, 0.3f, -1));
    ASSERT_EQ(placed.footprints().size(), 1u);
    EXPECT_LT(placed.footprints()[0].minimum.x, 1.5);
    EXPECT_GT(placed.footprints()[0].maximum.x, 2.5);
}

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
