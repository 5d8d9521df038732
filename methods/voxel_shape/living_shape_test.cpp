#include "methods/voxel_shape/living_shape.h"

#include <gtest/gtest.h>

namespace dustbench::voxel_shape {
namespace {

constexpr double trackStep = 1.0 / 60;

/// Returns a vehicle on a circle at a time: speed v = a·t, distance ½·a·t².
scene::SceneState onCircle(double radius, double acceleration, double time) {
    scene::SceneState state;
    const double angle = 0.5 * acceleration * time * time / radius;
    state.timeSeconds = time;
    state.vehicle.position = radius * glm::dvec3(std::sin(angle), 0, std::cos(angle));
    state.vehicle.heading = angle;
    state.vehicle.speed = acceleration * time;
    return state;
}

TEST(ShapeTrack, GivesTheVelocitiesOfItsPoses) {
    Track track;
    track.keys = {{0, {1, 0, 0}, 0, 1}, {2, {5, 0, 0}, 1, 2}};
    ShapeTrack moving(track);
    scene::SceneState state;
    for (int step = 0; step < 2; ++step) {
        state.timeSeconds = step * trackStep;
        const Pose pose = moving.advance(state, trackStep);
        EXPECT_NEAR(pose.velocity.x, 2, 1e-5f) << "from the first moment on";
        EXPECT_NEAR(pose.angularVelocity.y, 0.5f, 1e-5f);
        EXPECT_NEAR(pose.growth, 0.5 / (1 + state.timeSeconds / 2), 1e-5);
    }
    EXPECT_NEAR(momentAt(track, 3).key.position.x, 3, 1e-9) << "again and again";
}

TEST(ShapeTrack, TakesTheWayBackToItsFirstKeyForAJump) {
    Track track;
    track.followsVehicle = false;
    track.keys = {{0, {0, 0, 0}, 0, 1}, {1, {6, 0, 0}, 0, 1}};
    ShapeTrack moving(track);
    scene::SceneState state;
    for (int step = 0; step < 150; ++step) {
        state.timeSeconds = step * trackStep;
        EXPECT_NEAR(moving.advance(state, trackStep).velocity.x, 6, 1e-5f) << step;
    }
}

/// Compares the velocity of a track next to a vehicle on a circle with the difference quotient of its positions.
void expectVelocityOfItsMoment(const Track& track, int firstStep) {
    ShapeTrack beside(track);
    const double radius = 30, acceleration = 3;
    for (int step = 0; step < 240; ++step) {
        const double time = step * trackStep, h = 1e-4;
        const Pose pose = beside.advance(onCircle(radius, acceleration, time), trackStep);
        if (step < firstStep) continue;
        ShapeTrack before(track), after(track);
        const glm::dvec3 difference = glm::dvec3(after.advance(onCircle(radius, acceleration, time + h), h).position) -
                                      glm::dvec3(before.advance(onCircle(radius, acceleration, time - h), h).position);
        // The turn is the one since the last frame, so half a step old: 3 mm/s at 3.6 m from the vehicle's origin.
        const double turnIsLate = step == 0 ? 0 : acceleration / radius * trackStep / 2 * 3.7;
        EXPECT_LT(glm::distance(difference / (2 * h), glm::dvec3(pose.velocity)), turnIsLate + 0.03) << step;
    }
}

TEST(ShapeTrack, GivesAPlaceBesideAVehicleTheVelocityOfThatMoment) {
    Track track;
    track.keys = {{0, {-3, 1, 2}, 0.4, 1}};
    expectVelocityOfItsMoment(track, 0);
}

TEST(ShapeTrack, GivesAWayBesideAVehicleItsVelocityInTheWorld) {
    Track track;
    track.keys = {{0, {-3, 1, 2}, 0.4, 1}, {4.5, {3, 1.5, 1}, 0.4, 1}};
    expectVelocityOfItsMoment(track, 1);  // before time 0 the track is at its end
}

}  // namespace
}  // namespace dustbench::voxel_shape
