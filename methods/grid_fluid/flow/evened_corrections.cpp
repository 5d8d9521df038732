#include "methods/grid_fluid/flow/evened_corrections.h"

#include <cstring>
#include <utility>

#include "methods/grid_fluid/flow/lanes.h"

namespace dustbench::grid_fluid::flow {
namespace {

void mirror(CellField& corrections, const CellLayout& layout, glm::ivec3 ghost, glm::ivec3 cell, int records) {
    float* to = corrections.cell(layout.at(ghost.x, ghost.y, ghost.z));
    const auto count = static_cast<std::size_t>(records);
    std::memcpy(to, corrections.cell(layout.at(cell.x, cell.y, cell.z)), count * lanes * sizeof(float));
    for (int axis = 0; axis < 3; ++axis)
        if (ghost[axis] > cell[axis])
            for (std::size_t r = 0; r < count; ++r) to[r * lanes + static_cast<std::size_t>(axis)] = 0;
}

/// κ/4 for the float at `place` in a row of records.
constexpr float quarterKept(std::size_t place) {
    return 0.25f * (place % lanes < density ? keptOfSpeeds : keptOfCentres);
}

/// κ/4 for the floats of one vector, from `first` on.
template <typename Vector, std::size_t first>
constexpr Vector quartersKept() {
    return []<std::size_t... place>(std::index_sequence<place...>) {
        return Vector{quarterKept(first + place)...};
    }
    (std::make_index_sequence<sizeof(Vector) / sizeof(float)>{});
}

/// φ̂ + c' of a row, one vector of floats at a time; neighbours along y and z are `row` and `slab` floats away.
struct EvenedRow {
    const float *corrections, *guess;
    float* to;
    std::size_t row, slab;

    template <typename Vector, std::size_t first>
    [[gnu::always_inline]] void add(std::size_t at) const {
        const float* own = corrections + at;
        const auto c = load<Vector>(own);
        const auto evened = [&](std::size_t step) {
            return quartersKept<Vector, first>() * (load<Vector>(own - step) + 2.0f * c + load<Vector>(own + step));
        };
        const Vector x = evened(lanes), y = evened(row), z = evened(slab);
        const Vector least = atMost(atMost(c, x), atMost(y, z)), most = atLeast(atLeast(c, x), atLeast(y, z));
        store(to + at, load<Vector>(guess + at) + atLeast(least, Vector{}) + atMost(most, Vector{}));
    }
};

}  // namespace

void mirrorRow(CellField& corrections, const CellLayout& layout, int j, int k) {
    const int nx = layout.nx, ny = layout.ny, nz = layout.nz;
    mirror(corrections, layout, {-1, j, k}, {0, j, k}, 1);
    mirror(corrections, layout, {nx, j, k}, {nx - 1, j, k}, 1);
    if (j == 0) mirror(corrections, layout, {0, -1, k}, {0, 0, k}, nx);
    if (j == ny - 1) mirror(corrections, layout, {0, ny, k}, {0, j, k}, nx);
    if (k == 0) mirror(corrections, layout, {0, j, -1}, {0, j, 0}, nx);
    if (k == nz - 1) mirror(corrections, layout, {0, j, nz}, {0, j, k}, nx);
}

void addEvened(const CellField& corrections, const CellLayout& layout, int j, int k, const float* guess, float* to) {
    const EvenedRow of{corrections.cell(layout.at(0, j, k)), guess, to, layout.row * lanes, layout.slab * lanes};
    const auto nx = static_cast<std::size_t>(layout.nx);
    std::size_t i = 0;
    for (; i + 8 <= nx; i += 8) {  // eight records are three vectors
        of.add<Float16, 0>(i * lanes);
        of.add<Float16, 16>(i * lanes + 16);
        of.add<Float16, 32>(i * lanes + 32);
    }
    for (; i < nx; ++i) of.add<Float8, 0>(i * lanes);
}

}  // namespace dustbench::grid_fluid::flow
