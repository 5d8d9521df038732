// Position of a fluid's box: stationary, or following the vehicle by whole cells, so that its lattice stays fixed in
// the world.
//
// Units: metres. Frame: world. Threads: pure.
#pragma once

#include <glm/glm.hpp>

#include "methods/contract/scene.h"
#include "methods/grid_fluid/flow/fluid_box.h"
#include "methods/grid_fluid/fluid_setup.h"

namespace dustbench::grid_fluid {

/// The desired minimum corner, on the lattice of the box. A following box keeps the vehicle near the end in the driving
/// direction; its floor is the ground if the ground is level.
[[nodiscard]] glm::dvec3 wantedOrigin(const FluidSetup& setup, const flow::FluidBox& box, const scene::Terrain& terrain,
                                      const scene::VehicleState& vehicle);

/// Number of cells to move the box: zero until a minimum distance along an axis is reached, then the whole distance.
[[nodiscard]] glm::ivec3 dueScroll(const flow::FluidBox& box, const glm::dvec3& wantedOrigin);

}  // namespace dustbench::grid_fluid
