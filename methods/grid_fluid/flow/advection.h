// Carries all that a cell holds along the flow: back along the path, look up, and correct.
//
// Units: metres per second, cells. Threads: rows in blocks; each cell by itself.
// Source: Stam1999, 2.2 (semi-Lagrangian); Selle2008, Eq. 4 and 3.2 (MacCormack, clamped to the extrema or reverted).
// Departs: the path ahead is the one behind, mirrored: x₊ = x₋ + 2Δt·u(x), of second order as well and without a
// look-up; where either leaves the box, the first guess stays; a window of slabs is held instead of all first guesses.
#pragma once

#include <cstdint>

#include "methods/grid_fluid/flow/cell_field.h"

namespace dustbench::grid_fluid::flow {

enum class AdvectionScheme { semiLagrangian, macCormack };
/// What happens to a corrected value beyond the extrema of the eight cells around where its path began.
enum class Limit {
    clamp,   ///< it becomes the nearer of them
    revert,  ///< the first guess stays: edges of clouds gain far less
    none,
};

struct AdvectionRule {
    AdvectionScheme scheme = AdvectionScheme::macCormack;
    Limit limit = Limit::clamp;
};

class Advection {
 public:
    Advection(const CellLayout& layout, MemoryAccount& window) : layout_(layout), window_(window), places_(window) {}

    /// `from`, with ghosts filled, after `cellsPerSpeed` = Δt/h, into `to`. `fluid` is 1 for cells of fluid; what is
    /// not is copied. No speed along z exceeds `maximumSpeedZ`.
    void advect(const CellField& from, CellField& to, const std::uint8_t* fluid, AdvectionRule rule,
                float cellsPerSpeed, float maximumSpeedZ);

 private:
    struct Pass;
    /// Where a cell of the whole field lies in the window.
    [[nodiscard]] std::size_t inWindow(std::size_t at) const {
        return at / layout_.slab % heldSlabs_ * layout_.slab + at % layout_.slab;
    }
    struct KeptRow;
    /// Of row (j, k) of the whole field.
    [[nodiscard]] KeptRow keptRow(int j, int k);
    void predict(const Pass& pass, int firstSlab, int lastSlab);
    void correct(const Pass& pass, int firstSlab, int lastSlab);

    CellLayout layout_;
    LedgerVector<float> window_;  ///< first guesses of the slabs in work
    LedgerVector<float> places_;  ///< for each row of these slabs, where its air comes from: all x, all y, all z
    std::size_t heldSlabs_ = 1;
    std::size_t keptPitch_ = 0;  ///< numbers that a row takes of each, a multiple of sixteen
};

}  // namespace dustbench::grid_fluid::flow
