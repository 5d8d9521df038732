#include <algorithm>
#include <cmath>

#include "methods/weighted_oit/weighted_oit.h"

namespace dustbench::weighted_oit {

double plainWeight(Weight weight, double axisMetres, double alpha, double nearMetres) {
    const double z = std::abs(axisMetres);
    const auto within = [](double value) { return std::max(1e-2, std::min(3e3, value)); };
    switch (weight) {
        case Weight::eq7:
            return alpha * within(10 / (1e-5 + std::pow(z / 5, 2) + std::pow(z / 200, 6)));
        case Weight::eq8:
            return alpha * within(10 / (1e-5 + std::pow(z / 10, 3) + std::pow(z / 200, 6)));
        case Weight::eq9:
            return alpha * within(0.03 / (1e-5 + std::pow(z / 200, 4)));
        case Weight::eq10:  // d(z) = (n·f/z − f)/(n − f) → 1 − n/z for f → ∞
            return alpha * std::max(1e-2, 3e3 * std::pow(nearMetres / std::max(z, nearMetres), 3));
        case Weight::none:
            return 1;
    }
    return 1;
}

}  // namespace dustbench::weighted_oit
