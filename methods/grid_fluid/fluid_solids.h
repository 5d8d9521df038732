// The solids that the air flows around: the scene's solids, the vehicle with its wheels, and the ground.
//
// A rigid solid has one motion; each cell of a deforming solid has its own velocity.
// Units: SI. Frame: world. Owns: a byte for each cell, and a velocity where a solid deforms. Threads: one at a time.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <map>
#include <span>
#include <vector>

#include "methods/contract/scene.h"
#include "methods/contract/solid.h"
#include "methods/grid_fluid/flow/fluid_box.h"
#include "methods/grid_fluid/flow/solid_cells.h"
#include "methods/grid_fluid/mesh_cells.h"

namespace dustbench::grid_fluid {

/// A coarse mesh that stands for a fine one when it is voxelised: vertices in the same cube of a lattice are merged at
/// their mean, and triangles that shrink to a line are dropped. A closed mesh stays closed. In metres, in the mesh's
/// frame. Source: Crane2007, 30.2.4 (a proxy mesh for complex obstacles). Departs: the proxy is made, not modelled.
class ProxyMesh {
 public:
    /// `edgeMetres`: of the lattice's cubes.
    ProxyMesh(const scene::Mesh& mesh, float edgeMetres);

    /// Follows the mesh as it deforms: each vertex has the mean position and velocity of those that it stands for.
    /// `velocities` may be empty.
    void follow(const scene::Mesh& mesh, std::span<const glm::vec3> velocities);

    /// Has positions and indices only.
    [[nodiscard]] const scene::Mesh& mesh() const { return proxy_; }
    [[nodiscard]] std::span<const glm::vec3> velocities() const { return velocities_; }

 private:
    void takeMeans(std::span<const glm::vec3> values, std::vector<glm::vec3>& means) const;

    std::vector<std::uint32_t> clusters_;  ///< of each vertex of the fine mesh
    std::vector<std::uint32_t> sizes_;     ///< of each cluster
    scene::Mesh proxy_;
    std::vector<glm::vec3> velocities_;
};

class FluidSolids {
 public:
    /// `scene` must outlive this; so must `gpu`, which finds the cells if it is given. `proxyCells`: solids and vehicle
    /// are voxelised as proxies whose vertices are this many cells apart; 0: as they are. Throws InputError if more
    /// solids move than can be numbered.
    FluidSolids(const scene::Scene& scene, glm::ivec3 cells, MemoryAccount& account,
                flow_gl::CellsOnRays* gpu = nullptr, double proxyCells = 0);

    /// Voxelises the solids at their current poses into the box at its current position. Valid until the next call.
    [[nodiscard]] flow::SolidMask voxelise(const flow::FluidBox& box, const scene::SceneState& state);
    [[nodiscard]] std::span<const std::uint8_t> bodies() const { return cells_.bodies(); }

 private:
    enum Body : std::uint8_t { still = 1, carBody, firstWheel, firstSolid = firstWheel + 4 };
    void addGround(const flow::FluidBox& box);
    void addSolids(const flow::FluidBox& box, const scene::SceneState& state);
    /// `rest`: the mesh at rest, which is the same for a rigid one.
    void addMoving(const flow::FluidBox& box, const scene::Mesh& rest, const scene::Mesh& mesh,
                   const scene::SolidPose& pose, std::size_t body, std::span<const glm::vec3> deforming = {});
    /// The mesh that is voxelised, with its velocities.
    struct Voxelised {
        const scene::Mesh& mesh;
        std::span<const glm::vec3> deforming;
    };
    [[nodiscard]] Voxelised voxelised(const flow::FluidBox& box, const scene::Mesh& rest, const scene::Mesh& mesh,
                                      const scene::SolidPose& pose, std::span<const glm::vec3> deforming);

    const scene::Scene& scene_;
    double proxyCells_;
    std::map<const scene::Mesh*, ProxyMesh> proxies_;  ///< by the mesh at rest
    MeshCells cells_;
    std::vector<flow::BodyMotion> motions_;  ///< by Body, starting at `still`
    std::vector<glm::vec3> vertexVelocities_;
};

}  // namespace dustbench::grid_fluid
