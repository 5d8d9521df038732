#include "methods/kit/draw/placed_solids.h"

#include <map>
#include <stdexcept>
#include <utility>

#include "methods/kit/draw/panel_pass.h"
#include "methods/kit/draw/shadow_footprint.h"

namespace dustbench::draw {
namespace {

constexpr double marginMetres = 0.3;  // a few of the shadow map's texels

}  // namespace

PlacedSolids::PlacedSolids(const scene::Scene& scene, gpu::Device& device) : scene_(scene) {
    if (scene.solidPoses.size() != scene.solids.size())
        throw std::invalid_argument("OpaqueScene: every solid needs a pose");
    std::map<const scene::Mesh*, std::shared_ptr<SolidMesh>> shapes;
    for (std::size_t i = 0; i < scene.solids.size(); ++i) {
        const scene::Solid& solid = scene.solids[i];
        PlacedSolid placed;
        if (solid.motion != scene::SolidMotion::still) placed.moving = i;
        if (solid.motion == scene::SolidMotion::deforms) {
            placed.mesh = std::make_shared<SolidMesh>(device, solid);
        } else {
            std::shared_ptr<SolidMesh>& shape = shapes[solid.mesh.get()];
            if (!shape) shape = std::make_shared<SolidMesh>(device, solid);
            placed.mesh = shape;
        }
        add(*solid.mesh, scene.solidPoses[i].toWorld, std::move(placed));
    }
    for (const scene::Panel& panel : scene.panels) {
        if (panel.parent != scene::Panel::Parent::world) continue;
        const auto plate = std::make_shared<const scene::Mesh>(panelPlate(panel));
        PlacedSolid placed;
        placed.mesh = std::make_shared<SolidMesh>(device, scene::Solid{panel.name, plate});
        placed.castsOnly = true;
        add(*plate, glm::mat4(panel.toParent), std::move(placed));
    }
    joinFootprints();
}

bool PlacedSolids::moveTo(const scene::SceneState& state) {
    bool anyMoved = false;
    for (PlacedSolid& placed : all_) {
        if (!placed.moving || *placed.moving >= state.solids.size()) continue;
        const scene::SolidNow& solid = state.solids[*placed.moving];
        if (placed.toWorld == solid.pose.toWorld && placed.deformed == solid.shape) continue;
        const scene::Mesh& shape = scene::solidMesh(scene_, state, *placed.moving);
        if (placed.deformed != solid.shape) placed.mesh->reshape(shape);
        placed.deformed = solid.shape;
        place(placed, shape, solid.pose.toWorld);
        anyMoved = true;
    }
    if (anyMoved) joinFootprints();
    return anyMoved;
}

void PlacedSolids::add(const scene::Mesh& shape, const glm::mat4& pose, PlacedSolid solid) {
    place(solid, shape, pose);
    all_.push_back(std::move(solid));
}

void PlacedSolids::place(PlacedSolid& solid, const scene::Mesh& shape, const glm::mat4& pose) {
    solid.toWorld = pose;
    solid.centre = glm::dvec3(pose * glm::vec4(solid.mesh->centre(), 1));
    solid.radiusMetres = static_cast<double>(solid.mesh->radiusMetres() * glm::length(glm::vec3(pose[0])));
    solid.footprints = shadowFootprints(shape, pose, scene_.lights.toSun, scene_.terrain, marginMetres);
}

void PlacedSolids::joinFootprints() {
    footprints_.clear();
    for (const PlacedSolid& solid : all_)
        footprints_.insert(footprints_.end(), solid.footprints.begin(), solid.footprints.end());
    joinOverlapping(footprints_);
}

}  // namespace dustbench::draw
