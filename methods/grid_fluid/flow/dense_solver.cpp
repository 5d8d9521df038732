#include "methods/grid_fluid/flow/dense_solver.h"

#include <utility>

namespace dustbench::grid_fluid::flow {

void DenseSolver::factor(std::vector<double> matrix, std::size_t n) {
    lower_ = std::move(matrix);
    n_ = n;
    for (std::size_t c = 0; c < n; ++c) {
        const double original = lower_[c * n + c];
        double pivot = original;
        for (std::size_t k = 0; k < c; ++k) pivot -= lower_[c * n + k] * lower_[c * n + k] * lower_[k * n + k];
        const bool vanishes = !(pivot > 1e-7 * original);
        lower_[c * n + c] = vanishes ? 0 : pivot;
        for (std::size_t r = c + 1; r < n; ++r) {
            double sum = lower_[r * n + c];
            for (std::size_t k = 0; k < c; ++k) sum -= lower_[r * n + k] * lower_[c * n + k] * lower_[k * n + k];
            lower_[r * n + c] = vanishes ? 0 : sum / pivot;
        }
    }
}

void DenseSolver::solve(std::vector<double>& x) const {
    for (std::size_t r = 0; r < n_; ++r)
        for (std::size_t k = 0; k < r; ++k) x[r] -= lower_[r * n_ + k] * x[k];
    for (std::size_t r = 0; r < n_; ++r) x[r] = lower_[r * n_ + r] > 0 ? x[r] / lower_[r * n_ + r] : 0;
    for (std::size_t r = n_; r-- > 0;)
        for (std::size_t k = r + 1; k < n_; ++k) x[r] -= lower_[k * n_ + r] * x[k];
}

}  // namespace dustbench::grid_fluid::flow
