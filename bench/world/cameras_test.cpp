#include "bench/world/cameras.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "bench/world/vehicle_dynamics.h"
#include "methods/kit/testing/test_folder.h"

namespace dustbench::world {
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

using ::testing::HasSubstr;

const std::string header = "time_s,eye_x,eye_y,eye_z,target_x,target_y,target_z,fov_deg\n";

std::vector<CameraKey> randomKeys(unsigned seed, int count) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> place(-50, 50), gap(0.1, 3);
    std::vector<CameraKey> keys;
    double seconds = 0;
    for (int i = 0; i < count; ++i, seconds += gap(random)) {
        const auto point = [&] { return glm::dvec3(place(random), place(random), place(random)); };
        keys.push_back({seconds, point(), point(), 60 + 0.5 * place(random)});
    }
    return keys;
}

void expectNear(const glm::dvec3& a, const glm::dvec3& b, double tolerance) {
    EXPECT_LT(glm::distance(a, b), tolerance) << a.x << ' ' << a.y << ' ' << a.z;
}

TEST(CameraPath, GoesThroughItsKeysAndIsHeldOutside) {
    for (const unsigned seed : {1u, 2u, 3u}) {
        const std::vector<CameraKey> keys = randomKeys(seed, 6);
        const CameraPath path(keys);
        for (const CameraKey& key : keys) {
            expectNear(path.at(key.seconds).eye, key.eye, 1e-9);
            expectNear(path.at(key.seconds).target, key.target, 1e-9);
            EXPECT_NEAR(path.at(key.seconds).verticalFieldOfView, glm::radians(key.fieldOfViewDegrees), 1e-12);
        }
        expectNear(path.at(-100).eye, keys.front().eye, 1e-12);
        expectNear(path.at(1e5).target, keys.back().target, 1e-12);
    }
}

TEST(CameraPath, MovesWithContinuousVelocity) {
    constexpr double h = 1e-5;
    for (const unsigned seed : {4u, 5u, 6u}) {
        const std::vector<CameraKey> keys = randomKeys(seed, 6);
        const CameraPath path(keys);
        for (std::size_t i = 1; i + 1 < keys.size(); ++i) {
            const double t = keys[i].seconds;
            const glm::dvec3 before = (path.at(t).eye - path.at(t - h).eye) / h;
            const glm::dvec3 after = (path.at(t + h).eye - path.at(t).eye) / h;
            // The curvature of poses 100 m apart within 0.1 s is at most 1e5 m/s²: h times that.
            expectNear(before, after, 2);
        }
    }
}

TEST(CameraPath, IsTheParabolaThatItsKeysLieOn) {
    const auto exact = [](double t) { return glm::dvec3(3 * t, 2 + t * t, 5 - 2 * t + 0.5 * t * t); };
    std::vector<CameraKey> keys;
    for (const double t : {0.0, 0.7, 1.0, 2.5, 4.0}) keys.push_back({t, exact(t), {0, 0, -100}, 50});
    const CameraPath path(keys);
    for (double t = 0.7; t <= 2.5; t += 0.05) expectNear(path.at(t).eye, exact(t), 1e-9);  // with two neighbours
    EXPECT_GT(glm::distance(path.at(3.2).eye, exact(3.2)), 1e-3);  // the tangent at the end is the chord's
}

TEST(CameraPath, WrittenAndReadAgainIsTheSame) {
    const TestFolder folder;
    for (const unsigned seed : {7u, 8u, 9u})
        for (const int count : {1, 5}) {
            const CameraPath path(randomKeys(seed, count));
            EXPECT_EQ(CameraPath::read(path.rows()).keys(), path.keys());
            EXPECT_EQ(CameraPath::read(folder.write("path.csv", path.csv()).string()).keys(), path.keys());
        }
}

TEST(CameraPath, LooksStraightDownWithoutTurningIntoNothing) {
    const scene::View view{CameraPath::read("0,5,40,5,5,0,5,50").at(0), 64, 48};
    const glm::vec4 clip = view.worldToClip() * glm::vec4(5, 0, 5, 1);
    EXPECT_NEAR(clip.x / clip.w, 0, 1e-5);
    EXPECT_NEAR(clip.y / clip.w, 0, 1e-5);
}

TEST(CameraPath, SaysWhatIsWrongWithItsInput) {
    const auto message = [](const std::string& rows) { return inputError([&] { (void)CameraPath::read(rows); }); };
    EXPECT_THAT(message("above"), HasSubstr("got 'above', expected a .csv file or rows time_s,"));
    EXPECT_THAT(message("nowhere/path.csv"), HasSubstr("nowhere/path.csv"));
    EXPECT_THAT(message("0,1,2,3"), HasSubstr("4 cells, expected 8"));
    EXPECT_THAT(message("0,1,2,3,4,5,6,200"), HasSubstr("column 'fov_deg': got 200, expected a number 5..150"));
    EXPECT_THAT(message("0,1,2,3,1,2,3,50"), HasSubstr("the target equals the eye"));
    EXPECT_THAT(message("1,1,2,3,4,5,6,50;1,1,2,3,4,5,7,50"), HasSubstr("expected more than 1 (previous row)"));
    EXPECT_THAT(inputError([] { (void)CameraPath::parseText("time_s,x\n0,1\n", "p.csv"); }),
                HasSubstr("p.csv:1: not the columns"));
    EXPECT_THAT(inputError([] { (void)CameraPath::parseText(header, "p.csv"); }), HasSubstr("no rows"));
    EXPECT_THROW(CameraPath({}), std::invalid_argument);
}

}  // namespace
}  // namespace dustbench::world
