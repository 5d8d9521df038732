#include "bench/measure/rank_correlation.h"

#include <cmath>

namespace dustbench::bench {
namespace {

int sign(double value) {
    return (value > 0) - (value < 0);
}

}  // namespace

double rankCorrelation(std::span<const CostPoint> points) {
    if (points.size() < 2) return std::numeric_limits<double>::quiet_NaN();
    double concordance = 0, untiedLoads = 0, untiedCosts = 0;
    for (std::size_t i = 0; i < points.size(); ++i)
        for (std::size_t j = i + 1; j < points.size(); ++j) {
            const int load = sign(points[j].load - points[i].load), cost = sign(points[j].ms - points[i].ms);
            concordance += load * cost;
            untiedLoads += std::abs(load);
            untiedCosts += std::abs(cost);
        }
    const double norm = std::sqrt(untiedLoads * untiedCosts);
    return norm > 0 ? concordance / norm : 0;
}

}  // namespace dustbench::bench
