#include "methods/grid_fluid/fluid_solids.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>

namespace dustbench::grid_fluid {
namespace {

glm::dmat4 worldToCells(const flow::FluidBox& box) {
    return glm::translate(glm::scale(glm::dmat4(1), glm::dvec3(1 / box.spacingMetres)), -box.originMetres);
}

}  // namespace

FluidSolids::FluidSolids(const scene::Scene& scene, glm::ivec3 cells, MemoryAccount& account)
    : scene_(scene), cells_(cells, account) {}

flow::SolidMask FluidSolids::voxelise(const flow::FluidBox& box, const scene::SceneState& state) {
    cells_.clear();
    if (!scene_.terrain.isFlat() || box.originMetres.y < 0) addGround(box);
    for (std::size_t n = 0; n < scene_.solids.size(); ++n)
        cells_.add(*scene_.solids[n].mesh, worldToCells(box) * glm::dmat4(scene_.solidPoses[n].toWorld), still);
    if (scene_.vehicle) {
        const scene::VehiclePoses poses = scene::vehiclePoses(*scene_.vehicle, state.vehicle);
        addMoving(box, *scene_.vehicle->body.mesh, poses.body, carBody);
        for (std::size_t w = 0; w < poses.wheels.size(); ++w)
            addMoving(box, *scene_.vehicle->wheel.mesh, poses.wheels[w], firstWheel + w);
    }
    return {cells_.bodies(), motions_};
}

void FluidSolids::addGround(const flow::FluidBox& box) {
    for (int k = 0; k < box.cells.z; ++k)
        for (int i = 0; i < box.cells.x; ++i) {
            const glm::dvec3 place = box.originMetres + glm::dvec3(i + 0.5, 0, k + 0.5) * box.spacingMetres;
            const auto height =
                static_cast<double>(scene_.terrain.heightAt(static_cast<float>(place.x), static_cast<float>(place.z)));
            // Cells whose centre is below the ground.
            const double below = std::round((height - place.y) / box.spacingMetres);
            const int end = static_cast<int>(std::clamp(below, 0.0, static_cast<double>(box.cells.y)));
            for (int j = 0; j < end; ++j) cells_.set(i, j, k, still);
        }
}

void FluidSolids::addMoving(const flow::FluidBox& box, const scene::Mesh& mesh, const scene::SolidPose& pose,
                            std::size_t body) {
    const glm::dmat4 toCells = worldToCells(box) * glm::dmat4(pose.toWorld);
    cells_.add(mesh, toCells, static_cast<std::uint8_t>(body));
    flow::BodyMotion& motion = motions_[body - 1];
    motion.velocity = pose.velocity;
    motion.turnPerCell = pose.angularVelocity * static_cast<float>(box.spacingMetres);
    motion.centreCells = glm::vec3(toCells[3]);
}

}  // namespace dustbench::grid_fluid
