#include "bench/measure/unpaired_ratio.h"

#include <cmath>
#include <numeric>

namespace dustbench::bench {
namespace {

double mean(std::span<const double> x) {
    return std::accumulate(x.begin(), x.end(), 0.0) / static_cast<double>(x.size());
}

/// s²/n
double squaredError(std::span<const double> x, double mean) {
    double squares = 0;
    for (const double value : x) squares += (value - mean) * (value - mean);
    const auto n = static_cast<double>(x.size());
    return squares / (n - 1) / n;
}

}  // namespace

UnpairedRatio compareUnpairedLogs(std::span<const double> ofLogs, std::span<const double> withLogs) {
    UnpairedRatio result;
    result.ofCount = ofLogs.size();
    result.withCount = withLogs.size();
    if (ofLogs.empty() || withLogs.empty()) return result;
    const double x = mean(ofLogs), y = mean(withLogs);
    result.ratio = std::exp(x - y);
    if (ofLogs.size() < 2 || withLogs.size() < 2) return result;

    const auto n = static_cast<double>(ofLogs.size()), m = static_cast<double>(withLogs.size());
    const double a = squaredError(ofLogs, x), b = squaredError(withLogs, y);
    // Times without any scatter have no ν and need none: their interval is a point.
    result.degreesOfFreedom = a + b > 0 ? (a + b) * (a + b) / (a * a / (n - 1) + b * b / (m - 1)) : n + m - 2;
    const double half = studentQuantile((1 + intervalConfidence) / 2, result.degreesOfFreedom) * std::sqrt(a + b);
    result.low = std::exp(x - y - half);
    result.high = std::exp(x - y + half);
    if (result.hasEnough()) result.verdict = evaluateInterval(x - y - half, x - y + half);
    return result;
}

}  // namespace dustbench::bench
