// Where a fluid's box stands: still, or along with the vehicle by whole cells, so that its lattice stays fixed in the
// world.
//
// Units: metres. Frame: world. Threads: pure.
#pragma once

#include <glm/glm.hpp>

#include "methods/contract/scene.h"
#include "methods/grid_fluid/flow/fluid_box.h"
#include "methods/grid_fluid/fluid_setup.h"

namespace dustbench::grid_fluid {

/// The minimum corner where it is wanted, on the lattice of the box. A box that follows keeps its vehicle near the end
/// that it drives towards; its floor is the ground where that is level.
[[nodiscard]] glm::dvec3 wantedOrigin(const FluidSetup& setup, const flow::FluidBox& box, const scene::Terrain& terrain,
                                      const scene::VehicleState& vehicle);

/// By how many cells the box must move: not before some are due along an axis, then by all of them.
[[nodiscard]] glm::ivec3 dueScroll(const flow::FluidBox& box, const glm::dvec3& wantedOrigin);

}  // namespace dustbench::grid_fluid
