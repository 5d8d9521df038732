#include "methods/grid_fluid/fluid_place.h"

#include <algorithm>
#include <cmath>

namespace dustbench::grid_fluid {
namespace {

/// A scroll moves the whole box, so it is delayed until it is worthwhile.
constexpr int minimumCells = 4;

}  // namespace

glm::dvec3 wantedOrigin(const FluidSetup& setup, const flow::FluidBox& box, const scene::Terrain& terrain,
                        const scene::VehicleState& vehicle) {
    const glm::dvec3 extent = glm::dvec3(box.cells) * box.spacingMetres;
    if (!setup.followsVehicle) return setup.middleMetres - glm::dvec3(extent.x / 2, 0, extent.z / 2);
    const glm::dvec3 forward = vehicle.forward();
    glm::dvec3 origin = vehicle.position - extent / 2.0;
    for (const int axis : {0, 2}) origin[axis] -= forward[axis] * std::max(0.0, extent[axis] / 2 - setup.aheadMetres);
    origin.y = terrain.isFlat() ? 0 : vehicle.position.y - setup.belowMetres;
    return glm::round(origin / box.spacingMetres) * box.spacingMetres;
}

glm::ivec3 dueScroll(const flow::FluidBox& box, const glm::dvec3& wantedOrigin) {
    const glm::dvec3 cells = glm::round((wantedOrigin - box.originMetres) / box.spacingMetres);
    if (std::max({std::abs(cells.x), std::abs(cells.y), std::abs(cells.z)}) < minimumCells) return glm::ivec3(0);
    // A jump of the vehicle beyond the whole box empties it, however far it is.
    const glm::dvec3 maximum(1e6);
    return {glm::clamp(cells, -maximum, maximum)};
}

}  // namespace dustbench::grid_fluid
