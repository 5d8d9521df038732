// Scenes for the tests of this folder: boxes, and a vehicle made of boxes.
#pragma once

#include <array>
#include <cmath>
#include <memory>

#include "methods/contract/scene.h"

namespace dustbench::draw::test {

/// A box with sharp edges.
inline scene::Mesh box(const glm::vec3& minimum, const glm::vec3& maximum, const glm::vec3& colour) {
    scene::Mesh mesh;
    for (int axis = 0; axis < 3; ++axis)
        for (const float side : {-1.0f, 1.0f}) {
            const int u = (axis + 1) % 3, v = (axis + 2) % 3;
            const auto first = static_cast<std::uint32_t>(mesh.positions.size());
            for (int corner = 0; corner < 4; ++corner) {
                glm::vec3 position(0), normal(0);
                position[axis] = side > 0 ? maximum[axis] : minimum[axis];
                position[u] = corner == 1 || corner == 2 ? maximum[u] : minimum[u];
                position[v] = corner >= 2 ? maximum[v] : minimum[v];
                normal[axis] = side;
                mesh.positions.push_back(position);
                mesh.normals.push_back(normal);
                mesh.colours.push_back(colour);
            }
            for (const std::uint32_t corner : {0, 1, 2, 0, 2, 3})
                mesh.indices.push_back(first + (side > 0 ? corner : (4 - corner) % 4));
        }
    return mesh;
}

inline scene::Solid boxSolid(const glm::vec3& minimum, const glm::vec3& maximum, const glm::vec3& colour) {
    return {"box", std::make_shared<const scene::Mesh>(box(minimum, maximum, colour))};
}

inline scene::VehicleModel boxVehicle() {
    scene::VehicleModel model;
    auto body = std::make_shared<scene::Mesh>(box({-0.8f, 0.3f, -0.85f}, {3.4f, 0.9f, 0.85f}, {0.55f, 0.04f, 0.03f}));
    body->append(box({-0.4f, 0.9f, -0.75f}, {1.8f, 1.45f, 0.75f}, {0.03f, 0.04f, 0.05f}), glm::mat4(1));
    model.body = {"body", body};
    model.wheel = boxSolid({-0.23f, -0.23f, -0.11f}, {0.23f, 0.23f, 0.11f}, {0.02f, 0.02f, 0.02f});
    return model;
}

/// An empty scene with a high sun and a dim sky, so that shadows are short and dark.
inline scene::Scene underAHighSun() {
    scene::Scene scene;
    scene.lights.toSun = {0.45f, 0.62f, 0.64f};
    scene.lights.ambient = {0.30f, 0.34f, 0.42f};
    return scene;
}

/// The vehicle on the ground at (x, z), heading along +X.
inline scene::SceneState vehicleAt(const scene::Scene& scene, double x, double z) {
    const auto ground = [&](double a, double b) {
        return static_cast<double>(scene.terrain.heightAt(static_cast<float>(a), static_cast<float>(b)));
    };
    scene::SceneState state;
    state.vehicle.position = {x, ground(x, z), z};
    const scene::VehicleParameters& size = scene.vehicle->parameters;
    for (std::size_t i = 0; i < 4; ++i) {
        const double ahead = i < 2 ? size.wheelbaseMetres : 0;
        const double right = (i % 2 == 0 ? -0.5 : 0.5) * size.trackMetres;
        scene::WheelState& wheel = state.vehicle.wheels[i];
        wheel.contact = {x + ahead, ground(x + ahead, z + right), z + right};
        wheel.hub = wheel.contact + glm::dvec3(0, size.wheelRadiusMetres, 0);
    }
    return state;
}

/// Dunes tens of metres long on a grid of `samples`² heights, `spacing` metres apart, centred on the origin.
inline scene::Terrain dunes(int samples, float spacing) {
    std::vector<float> heights;
    for (int j = 0; j < samples; ++j)
        for (int i = 0; i < samples; ++i) {
            const float x = static_cast<float>(i) * spacing, z = static_cast<float>(j) * spacing;
            heights.push_back(2.5f * std::sin(x / 21 + 0.8f * std::sin(z / 37)) + 1.2f * std::sin(z / 13 + x / 29));
        }
    const float corner = -0.5f * static_cast<float>(samples - 1) * spacing;
    return {heights, samples, samples, spacing, corner, corner};
}

inline scene::View viewFrom(const glm::dvec3& eye, const glm::dvec3& target, int width = 640, int height = 480) {
    scene::View view;
    view.camera.eye = eye;
    view.camera.target = target;
    view.width = width;
    view.height = height;
    return view;
}

}  // namespace dustbench::draw::test
