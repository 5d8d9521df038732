// Advects all quantities of a cell: trace back along the path, sample, and correct.
//
// Units: metres per second, cells. Threads: rows in blocks; each cell by itself.
// Source: Stam1999, 2.2 (semi-Lagrangian); Selle2008, Eq. 4 and 3.2 (MacCormack, clamped to the extrema or reverted).
// Departs: the forward path is the mirrored backward path: x₊ = x₋ + 2Δt·u(x), also of second order, without another
// sample; if either path leaves the box, the first guess is kept; only a window of slabs of first guesses is stored.
#pragma once

#include <cstdint>

#include "methods/grid_fluid/flow/cell_field.h"

namespace dustbench::grid_fluid::flow {

enum class AdvectionScheme { semiLagrangian, macCormack };
/// Treatment of a corrected value outside the extrema of the eight cells around the departure point.
enum class Limit {
    clamp,   ///< use the nearer extremum
    revert,  ///< keep the first guess: cloud edges gain far less density
    none,
};

struct AdvectionRule {
    AdvectionScheme scheme = AdvectionScheme::macCormack;
    Limit limit = Limit::clamp;
};

class Advection {
 public:
    Advection(const CellLayout& layout, MemoryAccount& window) : layout_(layout), window_(window), places_(window) {}

    /// Advects `from`, with ghosts filled, by `cellsPerSpeed` = Δt/h into `to`. `fluid` is 1 for fluid cells; others
    /// are copied. The speed along z must not exceed `maximumSpeedZ`.
    void advect(const CellField& from, CellField& to, const std::uint8_t* fluid, AdvectionRule rule,
                float cellsPerSpeed, float maximumSpeedZ);

 private:
    struct Pass;
    /// Index in the window of a cell of the whole field.
    [[nodiscard]] std::size_t inWindow(std::size_t at) const {
        return at / layout_.slab % heldSlabs_ * layout_.slab + at % layout_.slab;
    }
    struct KeptRow;
    /// Of row (j, k) of the whole field.
    [[nodiscard]] KeptRow keptRow(int j, int k);
    void predict(const Pass& pass, int firstSlab, int lastSlab);
    void correct(const Pass& pass, int firstSlab, int lastSlab);

    CellLayout layout_;
    LedgerVector<float> window_;  ///< first guesses of the slabs in progress
    LedgerVector<float> places_;  ///< for each row of these slabs, its departure points: all x, all y, all z
    std::size_t heldSlabs_ = 1;
    std::size_t keptPitch_ = 0;  ///< numbers per row of each, a multiple of sixteen
};

}  // namespace dustbench::grid_fluid::flow
