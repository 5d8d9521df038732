#include "methods/contract/scene.h"

#include <algorithm>
#include <cmath>

namespace dustbench::scene {

bool anySolidMoves(const Scene& scene) {
    return std::ranges::any_of(scene.solids, [](const Solid& solid) { return solid.motion != SolidMotion::still; });
}

const SolidPose& solidPose(const Scene& scene, const SceneState& state, std::size_t solid) {
    return solid < state.solids.size() ? state.solids[solid].pose : scene.solidPoses[solid];
}

const Mesh& solidMesh(const Scene& scene, const SceneState& state, std::size_t solid) {
    if (solid < state.solids.size() && state.solids[solid].shape) return state.solids[solid].shape->mesh;
    return *scene.solids[solid].mesh;
}

glm::dmat4 panelToWorld(const Panel& panel, const SceneState& state) {
    return panel.parent == Panel::Parent::vehicle ? state.vehicle.toWorld() * panel.toParent : panel.toParent;
}

glm::vec3 dustColour(const Scene& scene) {
    // The cloud scatters incident light with albedo ϖ, isotropically (phase 1/4π). A white surface facing the sun reads
    // `sun`, so single scattering shows ϖ·sun/4; the sky is all around and shows ϖ·ambient. Half of the scattered light
    // leaves the cloud, the other half is scattered again: Σ ϖⁿ (½)ⁿ⁻¹ = ϖ / (1 − ϖ/2).
    const glm::vec3 albedo = scene.dustAlbedo;
    const glm::vec3 incoming = scene.lights.ambient + scene.lights.sun / 4.0f;
    return albedo / (1.0f - albedo / 2.0f) * incoming;
}

float phaseFactor(float asymmetry, float cosine) {
    const float g = asymmetry;
    const float square = 1 + g * g - 2 * g * cosine;
    return (1 - g * g) / (square * std::sqrt(square));
}

glm::vec3 dustLight(const Scene& scene, float transmittance, float cosine) {
    // The light of dustColour(), with the sun's part scaled by T and by the phase function.
    const glm::vec3 sun = scene.lights.sun / 4.0f, ambient = scene.lights.ambient;
    const glm::vec3 seen = ambient + phaseFactor(scene.dustAsymmetry, cosine) * transmittance * sun;
    const glm::vec3 all = ambient + sun;
    glm::vec3 share(0);
    for (int i = 0; i < 3; ++i)
        if (all[i] > 0) share[i] = seen[i] / all[i];
    return share;
}

namespace {

/// Wheel axes as columns: rolling direction, up, and the axle to the right; rotated about the axle by the rolled angle.
glm::mat4 wheelToWorld(const WheelState& wheel, const glm::dvec3& bodyUp, bool rightSide) {
    const glm::dvec3 axle = glm::normalize(glm::cross(wheel.forward, bodyUp));
    const glm::dvec3 up = glm::cross(axle, wheel.forward);
    // Rolling forwards moves the top of the wheel forwards: a negative rotation about the axle (+Z).
    const double angle = std::remainder(wheel.spinAngle, 2 * 3.14159265358979323846);
    const double cosine = std::cos(angle);
    const double sine = std::sin(angle);
    // The mesh's outer face looks to +Z. Left wheels are turned by 180° about the vertical, so they spin the other way.
    const double side = rightSide ? 1 : -1;
    glm::dmat4 matrix(1);
    matrix[0] = glm::dvec4(side * (cosine * wheel.forward - sine * up), 0);
    matrix[1] = glm::dvec4(sine * wheel.forward + cosine * up, 0);
    matrix[2] = glm::dvec4(side * axle, 0);
    matrix[3] = glm::dvec4(wheel.hub, 1);
    return glm::mat4(matrix);
}

}  // namespace

VehiclePoses vehiclePoses(const VehicleModel& model, const VehicleState& state) {
    // Yaw rate of the bicycle model: v tan δ / wheelbase, about the body's up axis.
    const double yawRate = state.speed * std::tan(state.steerAngle) / model.parameters.wheelbaseMetres;
    VehiclePoses poses;
    poses.body.toWorld = glm::mat4(state.toWorld());
    poses.body.velocity = glm::vec3(state.forward() * state.speed);
    poses.body.angularVelocity = glm::vec3(state.up * yawRate);
    for (std::size_t i = 0; i < poses.wheels.size(); ++i) {
        const WheelState& wheel = state.wheels[i];
        const glm::dvec3 axle = glm::normalize(glm::cross(wheel.forward, state.up));
        poses.wheels[i].toWorld = wheelToWorld(wheel, state.up, i == frontRight || i == rearRight);
        poses.wheels[i].velocity = glm::vec3(wheel.velocity);
        poses.wheels[i].angularVelocity = glm::vec3(state.up * yawRate - axle * wheel.spinRate);
    }
    return poses;
}

}  // namespace dustbench::scene
