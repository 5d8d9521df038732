#include "methods/grid_fluid/fluid_solids.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <limits>
#include <map>
#include <string>

#include "methods/contract/errors.h"

namespace dustbench::grid_fluid {
namespace {

glm::dmat4 worldToCells(const flow::FluidBox& box) {
    return glm::translate(glm::scale(glm::dmat4(1), glm::dvec3(1 / box.spacingMetres)), -box.originMetres);
}

}  // namespace

ProxyMesh::ProxyMesh(const scene::Mesh& mesh, float edgeMetres) {
    std::map<std::array<std::int64_t, 3>, std::uint32_t> numbers;
    for (const glm::vec3& p : mesh.positions) {
        const std::array<std::int64_t, 3> cube{std::llround(std::floor(p.x / edgeMetres)),
                                               std::llround(std::floor(p.y / edgeMetres)),
                                               std::llround(std::floor(p.z / edgeMetres))};
        const auto next = static_cast<std::uint32_t>(numbers.size());
        clusters_.push_back(numbers.try_emplace(cube, next).first->second);
    }
    sizes_.assign(numbers.size(), 0);
    for (const std::uint32_t cluster : clusters_) ++sizes_[cluster];
    for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3) {
        const std::uint32_t a = clusters_[mesh.indices[i]], b = clusters_[mesh.indices[i + 1]],
                            c = clusters_[mesh.indices[i + 2]];
        if (a != b && b != c && c != a) proxy_.indices.insert(proxy_.indices.end(), {a, b, c});
    }
    takeMeans(mesh.positions, proxy_.positions);
}

void ProxyMesh::takeMeans(std::span<const glm::vec3> values, std::vector<glm::vec3>& means) const {
    std::vector<glm::dvec3> sums(sizes_.size(), glm::dvec3(0));
    for (std::size_t v = 0; v < values.size(); ++v) sums[clusters_[v]] += glm::dvec3(values[v]);
    means.resize(sums.size());
    for (std::size_t k = 0; k < sums.size(); ++k) means[k] = glm::vec3(sums[k] / static_cast<double>(sizes_[k]));
}

void ProxyMesh::follow(const scene::Mesh& mesh, std::span<const glm::vec3> velocities) {
    takeMeans(mesh.positions, proxy_.positions);
    velocities_.clear();
    if (!velocities.empty()) takeMeans(velocities, velocities_);
}

FluidSolids::FluidSolids(const scene::Scene& scene, glm::ivec3 cells, MemoryAccount& account, flow_gl::CellsOnRays* gpu,
                         double proxyCells)
    : scene_(scene), proxyCells_(proxyCells), cells_(cells, account, gpu) {
    constexpr std::size_t maximum = std::numeric_limits<std::uint8_t>::max() - firstSolid + std::size_t{1};
    const auto moving = static_cast<std::size_t>(std::ranges::count_if(
        scene.solids, [](const scene::Solid& solid) { return solid.motion != scene::SolidMotion::still; }));
    if (moving > maximum)
        throw InputError("solids of scene '" + scene.id + "': got " + std::to_string(moving) +
                         " that move, allowed in a fluid: at most " + std::to_string(maximum));
    motions_.resize(firstSolid - still + moving);
}

flow::SolidMask FluidSolids::voxelise(const flow::FluidBox& box, const scene::SceneState& state) {
    cells_.clear();
    if (!scene_.terrain.isFlat() || box.originMetres.y < 0) addGround(box);
    addSolids(box, state);
    if (scene_.vehicle) {
        const scene::VehiclePoses poses = scene::vehiclePoses(*scene_.vehicle, state.vehicle);
        addMoving(box, *scene_.vehicle->body.mesh, *scene_.vehicle->body.mesh, poses.body, carBody);
        for (std::size_t w = 0; w < poses.wheels.size(); ++w)
            addMoving(box, *scene_.vehicle->wheel.mesh, *scene_.vehicle->wheel.mesh, poses.wheels[w], firstWheel + w);
    }
    cells_.finish();
    return {cells_.bodies(), motions_, cells_.velocities()};
}

void FluidSolids::addSolids(const flow::FluidBox& box, const scene::SceneState& state) {
    std::size_t body = firstSolid;
    for (std::size_t n = 0; n < scene_.solids.size(); ++n) {
        const scene::Mesh &mesh = scene::solidMesh(scene_, state, n), &rest = *scene_.solids[n].mesh;
        const scene::SolidPose& pose = scene::solidPose(scene_, state, n);
        if (scene_.solids[n].motion == scene::SolidMotion::still)
            cells_.add(voxelised(box, rest, mesh, pose, {}).mesh, worldToCells(box) * glm::dmat4(pose.toWorld), still);
        else if (n < state.solids.size() && state.solids[n].shape)
            addMoving(box, rest, mesh, pose, body++, state.solids[n].shape->velocities);
        else
            addMoving(box, rest, mesh, pose, body++);
    }
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

FluidSolids::Voxelised FluidSolids::voxelised(const flow::FluidBox& box, const scene::Mesh& rest,
                                              const scene::Mesh& mesh, const scene::SolidPose& pose,
                                              std::span<const glm::vec3> deforming) {
    if (!(proxyCells_ > 0)) return {mesh, deforming};
    const double scale = static_cast<double>(glm::length(glm::vec3(pose.toWorld[0])));
    const auto edge = static_cast<float>(proxyCells_ * box.spacingMetres / scale);
    ProxyMesh& proxy = proxies_.try_emplace(&rest, rest, edge).first->second;
    if (&mesh != &rest) proxy.follow(mesh, deforming);
    return {proxy.mesh(), proxy.velocities()};
}

void FluidSolids::addMoving(const flow::FluidBox& box, const scene::Mesh& rest, const scene::Mesh& fine,
                            const scene::SolidPose& pose, std::size_t body, std::span<const glm::vec3> velocities) {
    const auto [mesh, deforming] = voxelised(box, rest, fine, pose, velocities);
    const glm::dmat4 toCells = worldToCells(box) * glm::dmat4(pose.toWorld);
    // v = v₀ + ω×(p − p₀) + R·v′
    vertexVelocities_.clear();
    for (std::size_t v = 0; v < deforming.size(); ++v)
        vertexVelocities_.push_back(pose.velocity +
                                    glm::cross(pose.angularVelocity, glm::mat3(pose.toWorld) * mesh.positions[v]) +
                                    glm::mat3(pose.toWorld) * deforming[v]);
    cells_.add(mesh, toCells, static_cast<std::uint8_t>(body), vertexVelocities_);
    flow::BodyMotion& motion = motions_[body - 1];
    motion.byCell = !deforming.empty() && !cells_.velocities().empty();
    motion.velocity = pose.velocity;
    motion.turnPerCell = pose.angularVelocity * static_cast<float>(box.spacingMetres);
    motion.centreCells = glm::vec3(toCells[3]);
}

}  // namespace dustbench::grid_fluid
