#include "methods/contract/scene.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace dustbench::scene {
namespace {

void expectNear(const glm::dvec3& a, const glm::dvec3& b, double tolerance) {
    for (int i = 0; i < 3; ++i) EXPECT_NEAR(a[i], b[i], tolerance) << "component " << i;
}

Mesh triangle() {
    return {.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}},
            .normals = {{0, 0, 1}, {0, 0, 1}, {0, 0, 1}},
            .colours = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}},
            .indices = {0, 1, 2}};
}

TEST(Mesh, AppendMovesTurnsAndScalesTheOther) {
    Mesh mesh = triangle();
    // A quarter turn about Y, doubled, moved: (x, y, z) → (2z + 5, 2y, −2x).
    glm::mat4 transform(0);
    transform[0] = {0, 0, -2, 0};
    transform[1] = {0, 2, 0, 0};
    transform[2] = {2, 0, 0, 0};
    transform[3] = {5, 0, 0, 1};
    mesh.append(triangle(), transform);
    EXPECT_EQ(mesh.indices, (std::vector<std::uint32_t>{0, 1, 2, 3, 4, 5}));
    expectNear(mesh.positions[4], {5, 0, -2}, 1e-6);
    expectNear(mesh.normals[4], {1, 0, 0}, 1e-6);
    EXPECT_EQ(mesh.colours[5], glm::vec3(0, 0, 1));
    EXPECT_THROW(mesh.append(mesh, glm::mat4(1)), std::invalid_argument);
}

TEST(VehicleState, LooksAlongXAtHeadingZeroAndTowardsMinusZAfterALeftQuarterTurn) {
    VehicleState state;
    expectNear(state.forward(), {1, 0, 0}, 1e-12);
    state.heading = std::numbers::pi / 2;
    expectNear(state.forward(), {0, 0, -1}, 1e-12);
    expectNear(glm::dvec3(state.toWorld()[2]), {1, 0, 0}, 1e-12);  // right
}

TEST(VehicleState, FrameIsOrthonormalAndKeepsTheHeadingOnASlope) {
    VehicleState state;
    state.heading = 0.7;
    state.up = glm::normalize(glm::dvec3(0.2, 1, -0.3));
    const glm::dmat3 frame(state.toWorld());
    const glm::dmat3 square = glm::transpose(frame) * frame;
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j) EXPECT_NEAR(square[i][j], i == j ? 1 : 0, 1e-12);
    EXPECT_NEAR(glm::determinant(frame), 1, 1e-12);
    EXPECT_NEAR(std::atan2(-state.forward().z, state.forward().x), 0.7, 1e-12);
}

TEST(VehiclePoses, WheelsKeepTheirOuterFacesOutsideAndRollForwards) {
    VehicleModel model;
    VehicleState state;
    for (WheelState& wheel : state.wheels) wheel.spinAngle = 0.1;
    const VehiclePoses poses = vehiclePoses(model, state);
    for (std::size_t i = 0; i < 4; ++i) {
        const glm::mat3 frame(poses.wheels[i].toWorld);
        EXPECT_NEAR(glm::determinant(frame), 1, 1e-6);
        const bool right = i == frontRight || i == rearRight;
        expectNear(frame[2], {0, 0, right ? 1 : -1}, 1e-6);
        // The former top has moved forwards.
        expectNear(frame[1], {std::sin(0.1), std::cos(0.1), 0}, 1e-6);
    }
}

TEST(VehiclePoses, RimVelocityIsZeroWhereTheWheelTouchesTheGround) {
    VehicleModel model;
    VehicleState state;
    state.speed = 12;
    const double radius = model.parameters.wheelRadiusMetres;
    for (WheelState& wheel : state.wheels) {
        wheel.velocity = {12, 0, 0};
        wheel.spinRate = 12 / radius;
    }
    for (const SolidPose& wheel : vehiclePoses(model, state).wheels)
        expectNear(wheel.velocity + glm::cross(wheel.angularVelocity, glm::vec3(0, -radius, 0)), {0, 0, 0}, 1e-5);
}

TEST(DustColour, IsTheSumOverOrdersOfScattering) {
    Scene scene;
    glm::dvec3 sum(0);
    glm::dvec3 share = glm::dvec3(scene.dustAlbedo);
    for (int order = 0; order < 60; ++order) {
        sum += share * glm::dvec3(scene.lights.ambient + scene.lights.sun / 4.0f);
        share *= glm::dvec3(scene.dustAlbedo) / 2.0;
    }
    expectNear(dustColour(scene), sum, 1e-6);
}

TEST(DustLight, PhaseFunctionIsNormalisedAndHasItsMeanCosine) {
    for (const float g : {-0.5f, 0.0f, 0.3f, 0.6f, 0.9f}) {
        double sum = 0, mean = 0;
        constexpr int steps = 20000;
        for (int k = 0; k < steps; ++k) {
            const double cosine = -1 + (k + 0.5) * 2 / steps;
            const auto factor = static_cast<double>(phaseFactor(g, static_cast<float>(cosine)));
            sum += factor / steps;
            mean += cosine * factor / steps;
        }
        EXPECT_NEAR(sum, 1, 1e-4) << g;
        EXPECT_NEAR(mean, static_cast<double>(g), 1e-4) << g;
    }
}

TEST(DustLight, IsOneWhereAllLightArrivesAndAmbientLightRemains) {
    Scene scene;
    scene.dustAsymmetry = 0;
    EXPECT_EQ(dustLight(scene, 1, 0.3f), glm::vec3(1));
    const glm::vec3 dark = dustLight(scene, 0, 0.3f);
    const glm::vec3 left = scene.lights.ambient / (scene.lights.ambient + scene.lights.sun / 4.0f);
    for (int i = 0; i < 3; ++i) EXPECT_FLOAT_EQ(dark[i], left[i]);
    scene.dustAsymmetry = 0.6f;
    EXPECT_GT(dustLight(scene, 1, 0.9f).r, 1);
    EXPECT_LT(dustLight(scene, 1, -0.9f).r, 1);
    scene.lights.sun = scene.lights.ambient = glm::vec3(0);
    EXPECT_EQ(dustLight(scene, 1, 0.9f), glm::vec3(0));
}

TEST(DustColour, IsBlackWithoutLightAndTanInDaylight) {
    Scene scene;
    const glm::vec3 tan = dustColour(scene);
    EXPECT_GT(tan.r, tan.g);
    EXPECT_GT(tan.g, tan.b);
    EXPECT_LT(tan.r, 1);
    scene.lights.sun = scene.lights.ambient = glm::vec3(0);
    EXPECT_EQ(dustColour(scene), glm::vec3(0));
}

}  // namespace
}  // namespace dustbench::scene
