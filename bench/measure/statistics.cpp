#include "bench/measure/statistics.h"

#include <fmt/format.h>

#include <algorithm>
#include <boost/math/distributions/students_t.hpp>
#include <cmath>
#include <functional>
#include <limits>
#include <numeric>
#include <vector>

#include "methods/contract/choices.h"
#include "methods/contract/errors.h"

namespace dustbench::measure {
namespace {

constexpr double nothing = std::numeric_limits<double>::quiet_NaN();

constexpr Choices<Verdict> verdicts{{"FASTER", Verdict::faster},
                                    {"SLOWER", Verdict::slower},
                                    {"SAME", Verdict::same},
                                    {"UNRESOLVED", Verdict::unresolved}};

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

double studentQuantile(double p, double degreesOfFreedom) {
    return boost::math::quantile(boost::math::students_t(degreesOfFreedom), p);
}

std::string_view verdictName(Verdict verdict) {
    return verdicts.wordOf(verdict);
}

Verdict evaluateInterval(double lowLog, double highLog) {
    const double margin = std::log1p(sameMargin);
    if (highLog < -margin) return Verdict::faster;
    if (lowLog > margin) return Verdict::slower;
    return lowLog >= -margin && highLog <= margin ? Verdict::same : Verdict::unresolved;
}

PairedRatio evaluateLogRatios(std::span<const double> logRatios) {
    PairedRatio result;
    result.pairs = logRatios.size();
    if (logRatios.empty()) return result;
    const auto n = static_cast<double>(logRatios.size());
    const double mean = std::accumulate(logRatios.begin(), logRatios.end(), 0.0) / n;
    result.ratio = std::exp(mean);
    if (logRatios.size() < 2) return result;

    double squares = 0;
    for (const double x : logRatios) squares += (x - mean) * (x - mean);
    const double standardError = std::sqrt(squares / (n - 1) / n);
    const double half = studentQuantile((1 + intervalConfidence) / 2, n - 1) * standardError;
    result.low = std::exp(mean - half);
    result.high = std::exp(mean + half);
    if (result.pairs >= minimumPairs) result.verdict = evaluateInterval(mean - half, mean + half);
    return result;
}

PairedRatio comparePaired(std::span<const double> of, std::span<const double> with) {
    if (of.size() != with.size())
        throw InputError(fmt::format("paired times: got {} and {}, expected equally many", of.size(), with.size()));
    std::vector<double> logRatios;
    logRatios.reserve(of.size());
    for (std::size_t i = 0; i < of.size(); ++i) {
        for (const double time : {of[i], with[i]})
            if (!(time > 0) || !std::isfinite(time))
                throw InputError(fmt::format("paired times: got {} in pair {}, expected a number above 0", time, i));
        // Not the logarithm of the quotient, which can overflow.
        logRatios.push_back(std::log(of[i]) - std::log(with[i]));
    }
    return evaluateLogRatios(logRatios);
}

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

RatioOfMeans ratioOfMeans(std::span<const std::pair<double, double>> pairs, double level) {
    RatioOfMeans result;
    const auto n = static_cast<double>(pairs.size());
    double meanX = 0, meanY = 0;
    for (const auto& [x, y] : pairs) {
        meanX += x / n;
        meanY += y / n;
    }
    if (pairs.empty() || meanY == 0) return result;
    const double ratio = result.ratio = meanX / meanY;
    if (pairs.size() < 2) return result;
    double xx = 0, yy = 0, xy = 0;
    for (const auto& [x, y] : pairs) {
        xx += (x - meanX) * (x - meanX) / (n - 1) / n;
        yy += (y - meanY) * (y - meanY) / (n - 1) / n;
        xy += (x - meanX) * (y - meanY) / (n - 1) / n;
    }
    const double t = studentQuantile((1 + level) / 2, n - 1);
    const double g = t * t * yy / (meanY * meanY);
    if (g >= 1) return result;
    const double shift = t * t * xy / (meanY * meanY);  // g v_xy/v_yy
    const double apart = yy > 0 ? xx - xy * xy / yy : xx;
    const double variance = xx - 2 * ratio * xy + ratio * ratio * yy - g * apart;
    const double half = t / std::abs(meanY) * std::sqrt(std::max(variance, 0.0));
    result.low = (ratio - shift - half) / (1 - g);
    result.high = (ratio - shift + half) / (1 - g);
    return result;
}

}  // namespace dustbench::measure
