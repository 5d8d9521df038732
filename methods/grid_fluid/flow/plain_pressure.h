// The pressure equation and its sweeps, cell by cell; the reference implementation of PressureSolver.
//
//     Σ w·(qₙ − q) = f        over the six faces of each cell of fluid
//     q ← (Σ w·qₙ − f) / Σ w  one sweep
//
// w is the conductance of the neighbour; q is 0 outside the fluid. In double precision.
// Units: see projection.h. Source: Trottenberg2001, 2.1 (the five-point star's Jacobi and red-black Gauss-Seidel, here
// with seven points); Crane2007, 30.2.3.
#pragma once

#include <cstdint>
#include <vector>

#include "methods/grid_fluid/flow/cell_field.h"

namespace dustbench::grid_fluid::flow {

class PlainPressure {
 public:
    /// `conductance` (SolidCells) must outlive it. `f`: of all padded cells.
    PlainPressure(const CellLayout& layout, const std::uint8_t* conductance, std::vector<double> f)
        : q(layout.padded(), 0.0), layout_(layout), conductance_(conductance), f_(std::move(f)) {}

    /// Red cells, then black cells; the step of black cells is scaled by `relaxation`.
    void sweepGaussSeidel(double relaxation = 1);
    /// Updates all cells from their neighbours' previous values.
    void sweepJacobi();
    /// f − Σ w·(qₙ − q), 0 outside the fluid.
    [[nodiscard]] double residual(std::size_t at) const;
    [[nodiscard]] double maximumResidual() const;

    std::vector<double> q;  ///< of all padded cells, initially 0

 private:
    [[nodiscard]] double solved(std::size_t at) const;

    CellLayout layout_;
    const std::uint8_t* conductance_;
    std::vector<double> f_;
};

}  // namespace dustbench::grid_fluid::flow
