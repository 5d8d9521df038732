// A scene: its fixed contents (Scene) and its state at one moment (SceneState).
#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "methods/contract/solid.h"
#include "methods/contract/terrain.h"
#include "methods/contract/vehicle.h"
#include "methods/contract/view.h"

namespace dustbench::scene {

/// Sun, sky and air. Colours are linear RGB; a white surface facing a sun of 1 reads 1.
struct Lights {
    glm::vec3 toSun{-0.933013f, 0.258819f, -0.25f};  ///< unit vector towards the sun: 15° up, 165° from +X to −Z
    glm::vec3 sun{1.0f, 0.93f, 0.80f};
    glm::vec3 ambient{0.40f, 0.42f, 0.48f};  ///< from the sky, equal from all directions
    glm::vec3 skyZenith{0.16f, 0.33f, 0.68f};
    glm::vec3 skyHorizon{0.74f, 0.80f, 0.86f};
    float hazePerMetre = 0.0015f;  ///< extinction of the clear air, which fades to the horizon's colour
    /// True: the dust is lit by dustLight() and shadows itself, the ground and the vehicle. Only methods that take
    /// lights (MethodInfo::takesLights) then show it.
    bool onDust = false;
};

/// A lamp at a point: a white surface that faces it from a distance d reads intensity/d². It throws no shadows.
struct PointLight {
    glm::dvec3 position{0};      ///< world, m
    glm::vec3 intensity{0};      ///< m², linear RGB: what a white surface facing it at 1 m reads
    float radiusMetres = 0.05f;  ///< closer than this it does not get brighter; above 0
};

struct VehicleModel {
    VehicleParameters parameters;
    Solid body;
    Solid wheel;  ///< axis along +Z, centred on its hub; the outer face looks to +Z (the right side)
};

/// The texels of a relief as they are at the start of a run. Row 0 is the lowest.
struct Relief {
    int columns = 0, rows = 0;
    std::vector<float> depth;       ///< 0 at the face, 1 at the panel's full depth
    std::vector<glm::vec3> colour;  ///< linear RGB, 0..1
};

/// A plate whose face has a relief.
///
/// Frame: the panel's. The face is the plane z = 0 and looks towards +z; its centre is the origin; x runs along the
/// columns and y along the rows. The plate reaches from z = −depthMetres to z = 0. A panel may be curved
/// (kit/meshes/curved_panel.h); this then describes the frame of its relief.
struct Panel {
    enum class Parent { world, vehicle };

    std::string name;
    Parent parent = Parent::world;
    glm::dmat4 toParent{1};  ///< rotation and translation; metres
    glm::dvec2 sizeMetres{1};
    double depthMetres = 0.05;
    glm::dvec2 curvaturePerMetre{0};  ///< along x and y; above 0: the face bulges
    std::shared_ptr<const Relief> relief;
};

struct Scene {
    std::string id;
    Terrain terrain;
    Lights lights;
    glm::vec3 wind{0};                  ///< m/s, world
    std::vector<Solid> solids;          ///< without the vehicle
    std::vector<SolidPose> solidPoses;  ///< of `solids`; for moving ones, at the start of the drive
    std::vector<Panel> panels;
    std::optional<VehicleModel> vehicle;
    glm::vec3 dustAlbedo{0.64f, 0.54f, 0.42f};
    float dustAsymmetry = 0.6f;  ///< g of Henyey and Greenstein, −1..1: mean cosine of the angle of scattering
};

struct SceneState {
    double timeSeconds = 0;
    VehicleState vehicle;
    std::vector<SolidNow> solids{};  ///< in the order of Scene::solids; empty if none of them moves
};

/// Whether any of the scene's solids moves or deforms.
[[nodiscard]] DUSTBENCH_API bool anySolidMoves(const Scene& scene);
/// The pose of a solid, by its number, at this moment.
[[nodiscard]] DUSTBENCH_API const SolidPose& solidPose(const Scene& scene, const SceneState& state, std::size_t solid);
[[nodiscard]] DUSTBENCH_API const Mesh& solidMesh(const Scene& scene, const SceneState& state, std::size_t solid);

/// From the panel's frame to the world at this moment.
[[nodiscard]] DUSTBENCH_API glm::dmat4 panelToWorld(const Panel& panel, const SceneState& state);

/// The colour (linear RGB) that a cloud of dust shows: its albedo, lit by sky and sun from all sides.
[[nodiscard]] DUSTBENCH_API glm::vec3 dustColour(const Scene& scene);

/// How much light is scattered towards the eye, relative to a medium that scatters equally in all directions. `cosine`
/// is that of the angle between the direction from the eye and the direction to the sun.
/// Source: Henyey1941, Eq. 2.
[[nodiscard]] DUSTBENCH_API float phaseFactor(float asymmetry, float cosine);

/// The factor on a colour of dust if lights.onDust: single scattering of the share `transmittance` of the sunlight, and
/// ambient light, which reaches every point. 1 if all sunlight arrives and g is 0.
[[nodiscard]] DUSTBENCH_API glm::vec3 dustLight(const Scene& scene, float transmittance, float cosine);

/// World poses of the vehicle's body and of its four wheels (order of `Wheel`).
struct VehiclePoses {
    SolidPose body;
    std::array<SolidPose, 4> wheels;
};
[[nodiscard]] DUSTBENCH_API VehiclePoses vehiclePoses(const VehicleModel& model, const VehicleState& state);

}  // namespace dustbench::scene
