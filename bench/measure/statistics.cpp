#include "bench/measure/statistics.h"

#include <algorithm>
#include <functional>
#include <limits>
#include <numeric>
#include <vector>

namespace dustbench::bench {
namespace {

constexpr double nothing = std::numeric_limits<double>::quiet_NaN();

}  // namespace

double quantile(std::span<const double> values, double p) {
    if (values.empty()) return nothing;
    std::vector<double> sorted(values.begin(), values.end());
    std::ranges::sort(sorted);
    const double position = std::clamp(p, 0.0, 1.0) * static_cast<double>(sorted.size() - 1);
    const auto k = static_cast<std::size_t>(position);
    const double f = position - static_cast<double>(k);
    if (k + 1 >= sorted.size()) return sorted.back();
    return sorted[k] + f * (sorted[k + 1] - sorted[k]);
}

double median(std::span<const double> values) {
    return quantile(values, 0.5);
}

double minimum(std::span<const double> values) {
    return values.empty() ? nothing : std::ranges::min(values);
}

double maximum(std::span<const double> values) {
    return values.empty() ? nothing : std::ranges::max(values);
}

double averageFps(std::span<const double> frameMs) {
    if (frameMs.empty()) return nothing;
    return static_cast<double>(frameMs.size()) * 1000 / std::accumulate(frameMs.begin(), frameMs.end(), 0.0);
}

double lowFps(std::span<const double> frameMs, double share) {
    if (frameMs.empty()) return nothing;
    std::vector<double> slowestFirst(frameMs.begin(), frameMs.end());
    std::ranges::sort(slowestFirst, std::greater<>());
    const double target = share * std::accumulate(slowestFirst.begin(), slowestFirst.end(), 0.0);
    double sum = 0;
    for (const double ms : slowestFirst) {
        sum += ms;
        if (sum >= target) return 1000 / ms;
    }
    return 1000 / slowestFirst.back();
}

}  // namespace dustbench::bench
