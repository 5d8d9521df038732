#include "methods/grid_fluid/flow/plain_pressure.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace dustbench::grid_fluid::flow {
namespace {

std::array<std::size_t, 6> neighboursOf(const CellLayout& layout, std::size_t at) {
    return {at - 1, at + 1, at - layout.row, at + layout.row, at - layout.slab, at + layout.slab};
}

}  // namespace

double PlainPressure::solved(std::size_t at) const {
    double sum = -f_[at], weights = 0;
    for (const std::size_t n : neighboursOf(layout_, at)) {
        sum += conductance_[n] * q[n];
        weights += conductance_[n];
    }
    return weights > 0 ? sum / weights : 0;
}

void PlainPressure::sweepGaussSeidel(double relaxation) {
    for (const int colour : {0, 1})
        for (int k = 0; k < layout_.nz; ++k)
            for (int j = 0; j < layout_.ny; ++j)
                for (int i = 0; i < layout_.nx; ++i) {
                    const std::size_t at = layout_.at(i, j, k);
                    if (conductance_[at] != 1 || (i + j + k) % 2 != colour) continue;
                    q[at] += (colour == 0 ? 1 : relaxation) * (solved(at) - q[at]);
                }
}

void PlainPressure::sweepJacobi() {
    std::vector<double> next = q;
    for (int k = 0; k < layout_.nz; ++k)
        for (int j = 0; j < layout_.ny; ++j)
            for (int i = 0; i < layout_.nx; ++i)
                if (const std::size_t at = layout_.at(i, j, k); conductance_[at] == 1) next[at] = solved(at);
    q = next;
}

double PlainPressure::residual(std::size_t at) const {
    if (conductance_[at] != 1) return 0;
    double residual = f_[at];
    for (const std::size_t n : neighboursOf(layout_, at)) residual -= conductance_[n] * (q[n] - q[at]);
    return residual;
}

double PlainPressure::maximumResidual() const {
    double maximum = 0;
    for (int k = 0; k < layout_.nz; ++k)
        for (int j = 0; j < layout_.ny; ++j)
            for (int i = 0; i < layout_.nx; ++i) maximum = std::max(maximum, std::fabs(residual(layout_.at(i, j, k))));
    return maximum;
}

}  // namespace dustbench::grid_fluid::flow
