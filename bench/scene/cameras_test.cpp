#include "bench/scene/cameras.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "bench/scene/vehicle_dynamics.h"

namespace dustbench::bench {
namespace {

void expectNearly(const glm::dvec3& a, const glm::dvec3& b, double tolerance = 1e-9) {
    EXPECT_LT(glm::distance(a, b), tolerance) << a.x << ' ' << a.y << ' ' << a.z;
}

scene::SceneState at(double x, double z, double heading) {
    scene::SceneState state;
    state.vehicle = placeVehicle({}, {}, x, z, heading, 10);
    return state;
}

TEST(Cameras, ChaseGoesAlongWithTheVehicle) {
    const scene::SceneState state = at(100, 50, std::numbers::pi / 2);  // looks along −Z, its right is +X
    const CameraSet cameras;
    const scene::Camera camera =
        cameraAt(CameraKind::chase, cameras, state, CameraLag::at(state.vehicle), scene::Terrain{});
    const glm::dvec3 offset = cameras.chase.offset;
    expectNearly(camera.eye, {100 + offset.z, offset.y, 50 - offset.x});
}

TEST(Cameras, ChaseShowsTheCarAndFortyMetresOfItsTrail) {
    const scene::SceneState state = at(0, 0, 0);
    const scene::View view{cameraAt(CameraKind::chase, {}, state, CameraLag::at(state.vehicle), scene::Terrain{}), 640,
                           480};
    for (const double x : {3.4, 0.0, -10.0, -40.0}) {
        const glm::vec4 clip = view.worldToClip() * glm::vec4(x, 0.5, 0, 1);
        EXPECT_LT(std::abs(clip.x), clip.w) << x;
        EXPECT_LT(std::abs(clip.y), clip.w) << x;
    }
    // The horizon lies in the upper half of the picture, the sky above it.
    EXPECT_GT(view.rayDirection(320, 0).y, 0);
    EXPECT_LT(view.rayDirection(320, 240).y, 0);
}

TEST(Cameras, LagFollowsExponentiallyWhateverTheStep) {
    const scene::SceneState state = at(0, 0, 1);
    CameraLag coarse, fine;
    coarse = coarse.followed(state.vehicle, 0.5, 1);
    for (int n = 0; n < 100; ++n) fine = fine.followed(state.vehicle, 0.5, 0.01);
    EXPECT_NEAR(coarse.heading, 1 - std::exp(-2), 1e-12);
    EXPECT_NEAR(fine.heading, coarse.heading, 1e-12);
    EXPECT_EQ(coarse.followed(state.vehicle, 0, 0.01).heading, 1);
}

TEST(Cameras, FixedStands) {
    const CameraSet cameras;
    const scene::Camera camera = cameraAt(CameraKind::fixed, cameras, at(7, 8, 2), {}, scene::Terrain{});
    expectNearly(camera.eye, cameras.fixed.eye);
    expectNearly(camera.target, cameras.fixed.target);
}

TEST(Cameras, OrbitKeepsItsRadiusAndTurnsAtItsRate) {
    CameraSet cameras;
    cameras.orbit.startAngle = 0;
    scene::SceneState state = at(20, -5, 0);
    for (const double time : {0.0, 1.0, 7.5}) {
        state.timeSeconds = time;
        const scene::Camera camera =
            cameraAt(CameraKind::orbit, cameras, state, CameraLag::at(state.vehicle), scene::Terrain{});
        const glm::dvec3 arm = camera.eye - camera.target;
        EXPECT_NEAR(std::hypot(arm.x, arm.z), cameras.orbit.radiusMetres, 1e-9);
        EXPECT_NEAR(std::remainder(std::atan2(-arm.z, arm.x) - cameras.orbit.turnRate * time, 2 * std::numbers::pi), 0,
                    1e-9);
    }
}

TEST(Cameras, TheWheelsRidesAlongWithoutLag) {
    const CameraSet cameras;
    const scene::SceneState state = at(100, 50, std::numbers::pi / 2);  // looks along −Z, its right is +X
    const scene::Camera camera = cameraAt(CameraKind::wheel, cameras, state, {0, 7}, scene::Terrain{});
    const auto inWorld = [](const glm::dvec3& p) { return glm::dvec3(100 + p.z, p.y, 50 - p.x); };
    expectNearly(camera.eye, inWorld(cameras.wheel.offset));
    expectNearly(camera.target, inWorld(cameras.wheel.lookAt));
}

TEST(Cameras, NeverSinkIntoTheGround) {
    const scene::Terrain hill({50, 50, 50, 50}, 2, 2, 1000, -500, -500);
    scene::SceneState state = at(0, 0, 0);
    const scene::Camera camera = cameraAt(CameraKind::chase, {}, state, {}, hill);
    EXPECT_GT(camera.eye.y, 50);
}

}  // namespace
}  // namespace dustbench::bench
