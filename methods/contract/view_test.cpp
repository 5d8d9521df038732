#include "methods/contract/view.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace dustbench::scene {
namespace {

View slanted() {
    return {.camera = {.eye = {3, 4, -5}, .target = {10, 1, 2}, .verticalFieldOfView = 0.8, .nearMetres = 0.25},
            .width = 800,
            .height = 450};
}

/// Projects a world point: pixels from the image's top left corner, and depth.
glm::dvec3 project(const View& view, const glm::vec3& point) {
    const glm::vec4 clip = view.worldToClip() * glm::vec4(point, 1);
    return {(clip.x / clip.w + 1) / 2 * static_cast<float>(view.width),
            (1 - clip.y / clip.w) / 2 * static_cast<float>(view.height), clip.z / clip.w};
}

TEST(View, ShowsTheTargetInTheMiddle) {
    const View view = slanted();
    const glm::dvec3 pixel = project(view, glm::vec3(view.camera.target));
    EXPECT_NEAR(pixel.x, 400, 1e-3);
    EXPECT_NEAR(pixel.y, 225, 1e-3);
}

TEST(View, HasReversedDepthNearOverDistance) {
    const View view = slanted();
    const glm::dvec3 forward = glm::normalize(view.camera.target - view.camera.eye);
    EXPECT_NEAR(project(view, glm::vec3(view.camera.eye + 0.25 * forward)).z, 1, 1e-5);
    EXPECT_NEAR(project(view, glm::vec3(view.camera.eye + 100.0 * forward)).z, 0.0025, 1e-7);
    EXPECT_LT(project(view, glm::vec3(view.camera.eye + 1e6 * forward)).z, 1e-6);
}

TEST(View, SeesTheFieldOfViewFromEdgeToEdge) {
    const View view{
        .camera = {.eye = {0, 0, 0}, .target = {0, 0, -1}, .verticalFieldOfView = 1.2}, .width = 300, .height = 100};
    const double edge = std::tan(0.6);
    EXPECT_NEAR(project(view, glm::vec3(0, edge, -1)).y, 0, 1e-4);
    EXPECT_NEAR(project(view, glm::vec3(3 * edge, 0, -1)).x, 300, 1e-3);
}

TEST(View, CastsRaysThroughThePixelsThatPointsProjectTo) {
    const View view = slanted();
    std::mt19937 random(11);
    std::uniform_real_distribution<double> share(0, 1);
    for (int n = 0; n < 500; ++n) {
        const double x = 800 * share(random), y = 450 * share(random);
        const glm::vec3 direction = view.rayDirection(x, y);
        EXPECT_NEAR(glm::length(direction), 1, 1e-6);
        const double distance = 1 + 200 * share(random);
        const glm::dvec3 pixel = project(view, glm::vec3(view.camera.eye + distance * glm::dvec3(direction)));
        EXPECT_NEAR(pixel.x, x, 0.02);
        EXPECT_NEAR(pixel.y, y, 0.02);
    }
}

TEST(View, KeepsRightHandedOrthonormalAxes) {
    const glm::mat3 turn(slanted().worldToEye());
    const glm::mat3 square = turn * glm::transpose(turn);
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j) EXPECT_NEAR(square[i][j], i == j ? 1 : 0, 1e-6);
    EXPECT_NEAR(glm::determinant(turn), 1, 1e-6);
}

TEST(View, LooksStraightDownWithoutFailing) {
    const View view{.camera = {.eye = {0, 10, 0}, .target = {0, 0, 0}}};
    EXPECT_NEAR(project(view, glm::vec3(0, 0, 0)).x, 320, 1e-3);
    EXPECT_NEAR(view.rayDirection(320, 240).y, -1, 1e-6);
}

}  // namespace
}  // namespace dustbench::scene
