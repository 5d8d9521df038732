// The solids that the air flows around: the scene's, the vehicle with its wheels, and the ground.
//
// Units: SI. Frame: world. Owns: a byte for each cell. Threads: one at a time.
#pragma once

#include <array>

#include "methods/grid_fluid/mesh_cells.h"
#include "methods/shared/fluid/fluid_box.h"
#include "methods/shared/fluid/solid_cells.h"
#include "methods/shared/scene/scene.h"

namespace dustbench::grid_fluid {

class FluidSolids {
 public:
    /// `scene` must outlive it.
    FluidSolids(const scene::Scene& scene, glm::ivec3 cells, MemoryAccount& account);

    /// As they stand at this moment, for a box that stands where it does. Valid until the next call.
    [[nodiscard]] fluid::SolidMask voxelise(const fluid::FluidBox& box, const scene::SceneState& state);
    [[nodiscard]] std::span<const std::uint8_t> bodies() const { return cells_.bodies(); }

 private:
    enum Body : std::uint8_t { still = 1, carBody, firstWheel, last = firstWheel + 3 };
    void addGround(const fluid::FluidBox& box);
    void addMoving(const fluid::FluidBox& box, const scene::Mesh& mesh, const scene::SolidPose& pose, std::size_t body);

    const scene::Scene& scene_;
    MeshCells cells_;
    std::array<fluid::BodyMotion, last> motions_{};
};

}  // namespace dustbench::grid_fluid
