#include "methods/grid_fluid/flow/evened_corrections.h"

#include <cstring>

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

constexpr float ofSpeeds = 0.25f * keptOfSpeeds, ofCentres = 0.25f * keptOfCentres;
constexpr Float8 quarterKept{ofSpeeds, ofSpeeds, ofSpeeds, ofCentres, ofCentres, ofCentres, 0, 0};

/// κ/4·(c₋ + 2c + c₊)
[[gnu::always_inline]] inline Float8 evened(const Float8& own, const float* before, const float* behind) {
    return quarterKept * (load<Float8>(before) + 2.0f * own + load<Float8>(behind));
}

}  // namespace

void mirrorRow(CellField& corrections, const CellLayout& layout, int j, int k) {
    const int nx = layout.nx, ny = layout.ny;
    mirror(corrections, layout, {-1, j, k}, {0, j, k}, 1);
    mirror(corrections, layout, {nx, j, k}, {nx - 1, j, k}, 1);
    if (j == 0) mirror(corrections, layout, {0, -1, k}, {0, 0, k}, nx);
    if (j == ny - 1) mirror(corrections, layout, {0, ny, k}, {0, j, k}, nx);
}

void mirrorSlab(CellField& corrections, const CellLayout& layout, int ghostSlab, int slab) {
    for (int j = 0; j < layout.ny; ++j) mirror(corrections, layout, {0, j, ghostSlab}, {0, j, slab}, layout.nx);
}

void addEvened(const CellField& corrections, const CellLayout& layout, int j, int k, const float* guess, float* to) {
    const float* own = corrections.cell(layout.at(0, j, k));
    const std::size_t row = layout.row * lanes, slab = layout.slab * lanes;
    for (int i = 0; i < layout.nx; ++i, own += lanes, guess += lanes, to += lanes) {
        const auto c = load<Float8>(own);
        const Float8 x = evened(c, own - lanes, own + lanes), y = evened(c, own - row, own + row),
                     z = evened(c, own - slab, own + slab);
        const Float8 least = atMost(atMost(c, x), atMost(y, z)), most = atLeast(atLeast(c, x), atLeast(y, z));
        store(to, load<Float8>(guess) + atLeast(least, Float8{}) + atMost(most, Float8{}));
    }
}

}  // namespace dustbench::grid_fluid::flow
