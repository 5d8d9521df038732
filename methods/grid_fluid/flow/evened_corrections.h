// Filters grid-scale oscillation out of MacCormack's corrections before they are added to the first guess.
//
// A correction belongs to the end of a path, not to its beginning. Interpolation half-way between two cells removes a
// wave of two cells, and its correction would restore half of the wave at the old place, however far the flow carries
// it: stripes one cell wide. So the smoothed corrections along each axis, κ/4·(c₋ + 2c + c₊), limit a correction: the
// value nearest 0 is used, or 0 if their signs differ. Waves longer than 5 cells (speeds) and 10 cells (other
// quantities) keep their whole correction, and the order stays 2. κ weighs noise against the energy of short waves, as
// measured in reports/decisions/0006-fluid-grid.md. Corrections are stored in a separate field, with 0 where nothing is
// corrected. Threads: rows are independent. Departs: from Selle2008, who add whole corrections.
#pragma once

#include "methods/grid_fluid/flow/cell_field.h"

namespace dustbench::grid_fluid::flow {

/// κ for the speeds of faces, and for density, temperature and reaction.
inline constexpr float keptOfSpeeds = 1.5f, keptOfCentres = 1.1f;

/// Copies corrections of the outermost cells to the ghosts next to row (j, k). Ghosts on the far sides get no
/// correction for their faces, which do not move.
void mirrorRow(CellField& corrections, const CellLayout& layout, int j, int k);

/// φ = φ̂ + c' for the cells of row (j, k); `guess` and `to` are its first records.
void addEvened(const CellField& corrections, const CellLayout& layout, int j, int k, const float* guess, float* to);

}  // namespace dustbench::grid_fluid::flow
