// Solves a small symmetric, possibly singular system exactly: the coarsest level of the pressure's hierarchy.
//
// Source: GolubVanLoan2013, 4.1.2 (LDLᵀ). Departs: a vanishing pivot fixes its unknown at 0.
#pragma once

#include <cstddef>
#include <vector>

namespace dustbench::grid_fluid::flow {

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

}  // namespace dustbench::grid_fluid::flow
