// Solves for the pressure, by multigrid down to a residual or by the paper's Jacobi sweeps.
//
// It works in memory borrowed from the caller for each step; the operator is therefore rebuilt each step, which moving
// solids require anyway.
// Units: see projection.h. Threads: rows in blocks; the result does not depend on their number.
// Source: Trottenberg2001, 2.4 and 2.8 (cell-centred, red-black Gauss-Seidel); Crane2007, 30.2.3 (Jacobi).
// Departs: a coarse face conducts the mean of its finer faces, so that solids thinner than a coarse cell still count.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "methods/grid_fluid/flow/cell_field.h"
#include "methods/grid_fluid/flow/fluid_box.h"
#include "methods/grid_fluid/flow/poisson_level.h"

namespace dustbench::grid_fluid::flow {

/// Adjacent cells of fluid along x.
struct Run {
    int i, end, j, k;
};

/// The runs of each closed region of fluid, which has no outflow: its pressure is determined only up to a constant, and
/// its net inflow cannot be removed. In the order of cells. Empty if all fluid is connected to an open side.
[[nodiscard]] std::vector<std::vector<Run>> closedRegions(const CellLayout& layout, const std::uint8_t* conductance);

/// Solves a small symmetric, possibly singular system exactly: the coarsest level of the pressure's hierarchy.
/// Source: GolubVanLoan2013, 4.1.2 (LDLᵀ). Departs: a vanishing pivot fixes its unknown at 0.
class DenseSolver {
 public:
    /// `matrix` is n×n, row by row, symmetric and positive semidefinite.
    void factor(std::vector<double> matrix, std::size_t n);
    /// Solves in place.
    void solve(std::vector<double>& x) const;

 private:
    std::vector<double> lower_;
    std::size_t n_ = 0;
};

enum class PressureMethod { jacobi, multigrid };

struct PressureRule {
    PressureMethod method = PressureMethod::multigrid;
    int jacobiSweeps = 20;
    int maximumCycles = 30;    ///< of multigrid
    float tolerance = 0.001f;  ///< maximum residual, in the units of the right side
};

struct PressureResult {
    float residual = 0;     ///< max |f − Ap| at the end
    int cycles = 0;         ///< or sweeps
    float unremovable = 0;  ///< maximum absolute mean of f over a closed region, which no pressure can balance
};

class PressureSolver {
 public:
    PressureSolver(const CellLayout& layout, const Sides& sides);

    /// Number of floats to borrow.
    [[nodiscard]] std::size_t floatsNeeded() const { return floatsNeeded_; }
    /// Borrows memory and builds the operator for these solids (SolidCells::conductance). Data outside that memory is
    /// reused if the solids are the same as in the last call.
    void build(std::span<float> memory, const std::uint8_t* conductance, bool sameSolids = false);
    /// Fill in its right side before `solve`. Afterwards it contains the pressure.
    [[nodiscard]] PoissonLevel& finest() { return *levels_.front(); }
    [[nodiscard]] const PoissonLevel& finest() const { return *levels_.front(); }
    PressureResult solve(const PressureRule& rule);

 private:
    void layOut(Arena& arena);
    void factorCoarsest();
    void solveCoarsest();
    void cycle(std::size_t level);
    float balanceClosedRegions();
    PressureResult sweepJacobi(const PressureRule& rule);

    CellLayout layout_;
    std::uint8_t openSides_[6]{};
    std::size_t floatsNeeded_ = 0;
    std::vector<std::unique_ptr<PoissonLevel>> levels_;
    SplitField other_{};  ///< Jacobi's second field
    DenseSolver coarsest_;
    std::vector<std::vector<Run>> closed_;
};

}  // namespace dustbench::grid_fluid::flow
