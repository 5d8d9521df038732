#include "methods/grid_fluid/flow/plain_projection.h"

#include <algorithm>
#include <array>

namespace dustbench::grid_fluid::flow {

std::vector<double> plainDivergence(const CellField& cells, const CellLayout& layout, const std::uint8_t* conductance) {
    const std::array steps{std::size_t{1}, layout.row, layout.slab};
    std::vector<double> divergence(layout.padded(), 0.0);
    for (int k = 0; k < layout.nz; ++k)
        for (int j = 0; j < layout.ny; ++j)
            for (int i = 0; i < layout.nx; ++i) {
                const std::size_t at = layout.at(i, j, k);
                if (conductance[at] != 1) continue;
                for (std::size_t axis = 0; axis < 3; ++axis)
                    divergence[at] += static_cast<double>(cells.cell(at + steps[axis])[axis]) -
                                      static_cast<double>(cells.cell(at)[axis]);
            }
    return divergence;
}

std::vector<glm::dvec3> plainProjection(const CellField& cells, const CellLayout& layout,
                                        const std::uint8_t* conductance, const std::vector<double>& q) {
    const std::array steps{std::size_t{1}, layout.row, layout.slab};
    std::vector<glm::dvec3> result(layout.padded());
    for (std::size_t at = 0; at < layout.padded(); ++at)
        for (std::size_t axis = 0; axis < 3; ++axis)
            result[at][static_cast<int>(axis)] = static_cast<double>(cells.cell(at)[axis]);
    const glm::ivec3 size(layout.nx, layout.ny, layout.nz);
    for (int axis = 0; axis < 3; ++axis) {
        glm::ivec3 end = size;
        end[axis] += 1;
        for (int k = 0; k < end.z; ++k)
            for (int j = 0; j < end.y; ++j)
                for (int i = 0; i < end.x; ++i) {
                    const std::size_t at = layout.at(i, j, k), before = at - steps[static_cast<std::size_t>(axis)];
                    if (conductance[at] == 0 || conductance[before] == 0) continue;
                    result[at][axis] -= std::max(conductance[at], conductance[before]) * (q[at] - q[before]);
                }
    }
    return result;
}

}  // namespace dustbench::grid_fluid::flow
