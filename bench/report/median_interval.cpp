#include "bench/report/median_interval.h"

#include <algorithm>
#include <cmath>

#include "bench/measure/statistics.h"

namespace dustbench::report {

MedianInterval medianInterval(std::vector<double> values) {
    MedianInterval result;
    result.values = values.size();
    if (values.empty()) return result;
    std::ranges::sort(values);
    result.median = measure::median(values);

    const auto n = static_cast<double>(values.size());
    double term = std::exp2(-n), below = term;  // C(n, 0)/2ⁿ, and the sum over i < 1
    std::size_t rank = 1;
    for (double i = 1; 2 * (i + 1) <= n + 1; ++i) {
        term *= (n - i + 1) / i;
        if (1 - 2 * (below + term) < 0.95) break;
        below += term;
        rank = static_cast<std::size_t>(i) + 1;
    }
    result.low = values[rank - 1];
    result.high = values[values.size() - rank];
    result.probability = 1 - 2 * below;
    return result;
}

}  // namespace dustbench::report
