#include "bench/reference/camera_rays.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <stdexcept>
#include <vector>

namespace dustbench::reference {
namespace {

std::vector<scene::View> views() {
    std::vector<scene::View> all(4);
    all[0].camera = {{3, 2, 10}, {-4, 1, -2}, {0, 1, 0}, 0.9, 0.1};
    all[1].camera = {{0, 30, 0}, {0, 0, 0}, {0, 1, 0}, 0.6, 0.5};  // straight down: parallel to `up`
    all[2].camera = {{1, 2, 3}, {1, 2, 3}, {0, 1, 0}, 0.9, 0.1};   // eye and target coincide
    all[3].camera = {{-200, 4, 90}, {50, 80, -10}, {0.3, 1, 0.1}, 2.2, 0.1};
    all[1].width = 33;
    all[1].height = 70;
    return all;
}

TEST(CameraRays, AreThoseOfTheView) {
    for (const scene::View& view : views()) {
        const CameraRays rays(view);
        for (int y = 0; y < view.height; y += 7)
            for (int x = 0; x < view.width; x += 5) {
                const glm::dvec3 wanted(view.rayDirection(x + 0.5, y + 0.5));
                EXPECT_LT(glm::length(rays.direction(x, y) - wanted), 2e-7);
            }
    }
}

TEST(CameraRays, SlopesAndPixelsAreInverse) {
    for (const scene::View& view : views()) {
        const CameraRays rays(view);
        for (const double pixel : {-20.0, 0.0, 0.5, 17.3, 900.0}) {
            EXPECT_NEAR(rays.pixelX(rays.slopeX(pixel)), pixel, 1e-9);
            EXPECT_NEAR(rays.pixelY(rays.slopeY(pixel)), pixel, 1e-9);
        }
        const glm::dvec3 along = rays.turned(rays.direction(4, 9));
        EXPECT_NEAR(along.x / along.z, rays.columnSlope(4), 1e-12);
        EXPECT_NEAR(along.y / along.z, rays.rowSlope(9), 1e-12);
    }
}

TEST(CameraRays, RefuseACameraOfNoNumbers) {
    scene::View view;
    view.camera.eye.x = std::nan("");
    EXPECT_THROW(CameraRays{view}, std::invalid_argument);
    view = {};
    view.camera.verticalFieldOfView = 0;
    EXPECT_THROW(CameraRays{view}, std::invalid_argument);
    view = {};
    view.height = 0;
    EXPECT_THROW(CameraRays{view}, std::invalid_argument);
}

TEST(OpaqueDistances, UndoTheReversedDepthOfPointsOnTheRays) {
    for (const scene::View& view : views()) {
        const CameraRays rays(view);
        std::vector<float> depths;
        std::vector<double> wanted;
        for (int y = 0; y < view.height; ++y)
            for (int x = 0; x < view.width; ++x) {
                // A point on the pixel's ray, projected by the same matrix that OpenGL gets.
                const double metres = 1 + (x + 3 * y) % 50;
                const glm::dvec3 point = rays.turned(rays.direction(x, y)) * metres;
                const glm::vec4 clip = view.eyeToClip() * glm::vec4(glm::dvec4(point.x, point.y, -point.z, 1));
                depths.push_back(clip.z / clip.w);
                wanted.push_back(metres);
            }
        const OpaqueDistances distances = distancesFromDepth(view, depths);
        ASSERT_EQ(distances.metres.size(), wanted.size());
        for (std::size_t i = 0; i < wanted.size(); ++i) EXPECT_NEAR(distances.metres[i] / wanted[i], 1, 4e-7);
    }
}

TEST(OpaqueDistances, AreInfiniteInTheSky) {
    const scene::View view;
    std::vector<float> depths(640 * 480, 0.0f);
    depths[641] = 1;
    const OpaqueDistances distances = distancesFromDepth(view, depths);
    EXPECT_EQ(distances.metres[640], std::numeric_limits<double>::infinity());
    EXPECT_GE(distances.metres[641], view.camera.nearMetres);
    for (const double metres : skyDistances(view).metres) ASSERT_EQ(metres, std::numeric_limits<double>::infinity());
}

TEST(OpaqueDistances, RefuseOtherSizesAndDepthsThatAreNone) {
    const scene::View view;
    std::vector<float> depths(640 * 480, 0.5f);
    EXPECT_NO_THROW(checkDistances(view, distancesFromDepth(view, depths)));
    for (const float bad : {-0.1f, 1.1f, std::nanf(""), HUGE_VALF}) {
        depths[77] = bad;
        EXPECT_THROW(std::ignore = distancesFromDepth(view, depths), std::invalid_argument) << bad;
    }
    depths.pop_back();
    EXPECT_THROW(std::ignore = distancesFromDepth(view, depths), std::invalid_argument);
    OpaqueDistances distances = skyDistances(view);
    distances.metres[5] = std::nan("");
    EXPECT_THROW(checkDistances(view, distances), std::invalid_argument);
    distances.metres[5] = -1;
    EXPECT_THROW(checkDistances(view, distances), std::invalid_argument);
    distances = skyDistances(view);
    distances.height = 479;
    EXPECT_THROW(checkDistances(view, distances), std::invalid_argument);
}

}  // namespace
}  // namespace dustbench::reference
