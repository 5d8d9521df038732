// Exact solution of a small symmetric system that may be singular: the bottom of the pressure's hierarchy.
//
// Source: GolubVanLoan2013, 4.1.2 (LDLᵀ). Departs: a pivot that vanishes fixes its unknown at 0.
#pragma once

#include <cstddef>
#include <vector>

namespace dustbench::grid_fluid::flow {

class DenseSolver {
 public:
    /// `matrix` of n×n, row after row, symmetric and not negative.
    void factor(std::vector<double> matrix, std::size_t n);
    /// In place.
    void solve(std::vector<double>& x) const;

 private:
    std::vector<double> lower_;
    std::size_t n_ = 0;
};

}  // namespace dustbench::grid_fluid::flow
