#include "methods/grid_fluid/flow/fluid_box.h"

#include <cmath>
#include <string>

#include "methods/contract/errors.h"

namespace dustbench::grid_fluid::flow {
namespace {

constexpr int minimumCells = 4;
constexpr int maximumCells = 4096;

}  // namespace

Sides withWind(Sides sides, const glm::vec3& wind) {
    for (int axis = 0; axis < 3; ++axis) {
        if (wind[axis] == 0.0f) continue;
        Side& upwind = sides[static_cast<std::size_t>(2 * axis + (wind[axis] > 0 ? 0 : 1))];
        if (upwind == Side::open) upwind = Side::inflow;
    }
    return sides;
}

void check(const FluidBox& box) {
    const auto text = [&] {
        return std::to_string(box.cells.x) + "x" + std::to_string(box.cells.y) + "x" + std::to_string(box.cells.z);
    };
    for (int axis = 0; axis < 3; ++axis)
        if (box.cells[axis] < minimumCells || box.cells[axis] > maximumCells)
            throw InputError("grid: got " + text() + " cells, allowed: " + std::to_string(minimumCells) + " to " +
                             std::to_string(maximumCells) + " along each edge");
    if (!(box.spacingMetres > 0) || !std::isfinite(box.spacingMetres))
        throw InputError("spacing: got " + std::to_string(box.spacingMetres) + " m, allowed: more than 0");
    for (int axis = 0; axis < 3; ++axis)
        if (!std::isfinite(box.originMetres[axis]))
            throw InputError("origin of the grid: got " + std::to_string(box.originMetres[axis]) +
                             ", allowed: finite numbers");
}

}  // namespace dustbench::grid_fluid::flow
