// The solids that the air flows around: the scene's solids, the vehicle with its wheels, and the ground.
//
// Units: SI. Frame: world. Owns: a byte for each cell. Threads: one at a time.
#pragma once

#include <array>

#include "methods/contract/scene.h"
#include "methods/grid_fluid/flow/fluid_box.h"
#include "methods/grid_fluid/flow/solid_cells.h"
#include "methods/grid_fluid/mesh_cells.h"

namespace dustbench::grid_fluid {

class FluidSolids {
 public:
    /// `scene` must outlive it.
    FluidSolids(const scene::Scene& scene, glm::ivec3 cells, MemoryAccount& account);

    /// Voxelises the solids at their current poses into the box at its current position. Valid until the next call.
    [[nodiscard]] flow::SolidMask voxelise(const flow::FluidBox& box, const scene::SceneState& state);
    [[nodiscard]] std::span<const std::uint8_t> bodies() const { return cells_.bodies(); }

 private:
    enum Body : std::uint8_t { still = 1, carBody, firstWheel, last = firstWheel + 3 };
    void addGround(const flow::FluidBox& box);
    void addMoving(const flow::FluidBox& box, const scene::Mesh& mesh, const scene::SolidPose& pose, std::size_t body);

    const scene::Scene& scene_;
    MeshCells cells_;
    std::array<flow::BodyMotion, last> motions_{};
};

}  // namespace dustbench::grid_fluid
