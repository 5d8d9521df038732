// A scene: what is there (Scene, fixed for a run) and how it stands at one moment (SceneState).
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <optional>
#include <string>
#include <vector>

#include "methods/shared/scene/lights.h"
#include "methods/shared/scene/solid.h"
#include "methods/shared/scene/terrain.h"
#include "methods/shared/scene/vehicle.h"
#include "methods/shared/scene/view.h"

namespace dustbench::scene {

struct VehicleModel {
    VehicleParameters parameters;
    Solid body;
    Solid wheel;  ///< axis along +Z, centred on its hub; the outer face looks to +Z (the right side)
};

struct Scene {
    std::string id;
    Terrain terrain;
    Lights lights;
    glm::vec3 wind{0};                  ///< m/s, world
    std::vector<Solid> solids;          ///< besides the vehicle
    std::vector<SolidPose> solidPoses;  ///< of `solids`
    std::optional<VehicleModel> vehicle;
    glm::vec3 dustAlbedo{0.64f, 0.54f, 0.42f};
    double octreeEdgeMetres = 128;  ///< of the octree's world: a cube that follows the vehicle
};

struct SceneState {
    double timeSeconds = 0;
    VehicleState vehicle;
};

/// The colour a cloud of dust shows: its albedo lit by sky and sun as a cloud is, from all sides (linear RGB).
[[nodiscard]] glm::vec3 dustColour(const Scene& scene);

/// World poses of the vehicle's body and of its four wheels (order of `Wheel`).
struct VehiclePoses {
    SolidPose body;
    std::array<SolidPose, 4> wheels;
};
[[nodiscard]] VehiclePoses vehiclePoses(const VehicleModel& model, const VehicleState& state);

}  // namespace dustbench::scene
