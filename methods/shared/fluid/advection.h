// Carries all that a cell holds along the flow: back along the path, look up, and correct.
//
// Units: metres per second, cells. Threads: rows in blocks; each cell by itself.
// Source: Stam1999, 2.2 (semi-Lagrangian); Selle2008, Eq. 4 and 3.2 (MacCormack, clamped to the extrema).
// Departs: where the forward path leaves the box, the first guess stays; with slabs computed in passing, a window of
// the first guess is held instead of all of it.
#pragma once

#include <cstdint>
#include <vector>

#include "methods/shared/fluid/cell_field.h"

namespace dustbench::fluid {

enum class AdvectionScheme { semiLagrangian, macCormack };

struct AdvectionRule {
    AdvectionScheme scheme = AdvectionScheme::macCormack;
    bool clampToExtrema = true;
};

class Advection {
 public:
    Advection(const CellLayout& layout, MemoryAccount& window) : layout_(layout), window_(window), nodes_(window) {}

    /// `from`, with ghosts filled, after `cellsPerSpeed` = Δt/h, into `to`. `fluid` is 1 for cells of fluid; what is
    /// not is copied. No speed along z exceeds `mostSpeedZ`.
    void advect(const CellField& from, CellField& to, const std::uint8_t* fluid, AdvectionRule rule,
                float cellsPerSpeed, float mostSpeedZ);

 private:
    struct Pass;
    void predict(const Pass& pass, int firstSlab, int lastSlab);
    void correct(const Pass& pass, int firstSlab, int lastSlab);

    CellLayout layout_;
    LedgerVector<float> window_;         ///< first guesses of the slabs in work
    LedgerVector<std::uint32_t> nodes_;  ///< for each of these cells, the corner from which it was looked up
    std::vector<std::uint32_t> fieldSlabs_, windowSlabs_;
};

}  // namespace dustbench::fluid
