// What of MacCormack's corrections is added to the first guess: nothing of what alternates from cell to cell.
//
// A correction belongs to where a path ends, not to where it began. Interpolation half-way between two cells leaves
// nothing of a wave of two cells, and half of it, as its own correction, would stay where it is, however far the flow
// carries it: stripes one cell wide. So a correction keeps what it has in common with the evened corrections along each
// axis, κ/4·(c₋ + 2c + c₊): the one nearest 0, or 0 if their signs differ. Waves of more than 5 cells (of speeds) and
// 10 cells (of the rest) keep all of it, and the order stays 2. κ weighs noise against the energy of short waves, as
// measured in reports/decisions/0006-fluid-grid.md. Corrections lie in a field of their own; that of what is not
// corrected is 0. Threads: rows apart. Departs: from Selle2008, who add whole corrections.
#pragma once

#include "methods/grid_fluid/flow/cell_field.h"

namespace dustbench::grid_fluid::flow {

/// κ of the speeds of faces, and of density, temperature and reaction.
inline constexpr float keptOfSpeeds = 1.5f, keptOfCentres = 1.1f;

/// Gives the ghosts beside row (j, k) the corrections of the cells within, and those on the far sides none for their
/// faces, which do not move.
void mirrorRow(CellField& corrections, const CellLayout& layout, int j, int k);

/// φ = φ̂ + c' for the cells of row (j, k); `guess` and `to` are its first records.
void addEvened(const CellField& corrections, const CellLayout& layout, int j, int k, const float* guess, float* to);

}  // namespace dustbench::grid_fluid::flow
