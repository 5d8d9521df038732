#include "methods/grid_fluid/flow/plain_projection.h"

#include <array>

namespace dustbench::grid_fluid::flow {
namespace {

template <typename Cell>
void forFluid(const CellLayout& layout, const std::uint8_t* conductance, const Cell& cell) {
    for (int k = 0; k < layout.nz; ++k)
        for (int j = 0; j < layout.ny; ++j)
            for (int i = 0; i < layout.nx; ++i)
                if (const std::size_t at = layout.at(i, j, k); conductance[at] == 1) cell(at);
}

/// Returns the component of u along an axis.
double speed(const CellField& cells, std::size_t at, std::size_t axis) {
    return static_cast<double>(cells.cell(at)[axis]);
}

/// Returns u_f of the face between a fluid cell and a neighbour.
double faceSpeed(const CellField& cells, const std::uint8_t* conductance, std::size_t at, std::size_t neighbour,
                 std::size_t axis) {
    if (conductance[neighbour] == 0) return speed(cells, neighbour, axis);
    return 0.5 * (speed(cells, at, axis) + speed(cells, neighbour, axis));
}

}  // namespace

std::vector<double> plainDivergence(const CellField& cells, const CellLayout& layout, const std::uint8_t* conductance) {
    const std::array steps{std::size_t{1}, layout.row, layout.slab};
    std::vector<double> divergence(layout.padded(), 0.0);
    forFluid(layout, conductance, [&](std::size_t at) {
        for (std::size_t axis = 0; axis < 3; ++axis)
            divergence[at] += faceSpeed(cells, conductance, at, at + steps[axis], axis) -
                              faceSpeed(cells, conductance, at, at - steps[axis], axis);
    });
    return divergence;
}

std::vector<glm::dvec3> plainProjection(const CellField& cells, const CellLayout& layout,
                                        const std::uint8_t* conductance, const std::vector<double>& q) {
    const std::array steps{std::size_t{1}, layout.row, layout.slab};
    std::vector<glm::dvec3> result(layout.padded());
    for (std::size_t at = 0; at < layout.padded(); ++at)
        for (std::size_t axis = 0; axis < 3; ++axis) result[at][static_cast<int>(axis)] = speed(cells, at, axis);
    forFluid(layout, conductance, [&](std::size_t at) {
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const std::size_t before = at - steps[axis], behind = at + steps[axis];
            double& u = result[at][static_cast<int>(axis)];
            if (conductance[before] == 0 || conductance[behind] == 0)
                u = 0.5 *
                    (faceSpeed(cells, conductance, at, before, axis) + faceSpeed(cells, conductance, at, behind, axis));
            u -= 0.5 * (conductance[before] * (q[at] - q[before]) + conductance[behind] * (q[behind] - q[at]));
        }
    });
    return result;
}

}  // namespace dustbench::grid_fluid::flow
