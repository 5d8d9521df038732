#include "bench/measure/cost_fit.h"

#include <algorithm>
#include <boost/math/distributions/fisher_f.hpp>
#include <cmath>
#include <glm/glm.hpp>
#include <set>

#include "bench/measure/statistics.h"

namespace dustbench::measure {
namespace {

constexpr std::size_t minimumLoads = 4;

struct Line {
    double a = 0, b = 0;
    double squares = 0;  ///< Σ residual²
};

/// The best a ≥ 0 and b for a given exponent; x = N^k.
Line fitLine(std::span<const CostPoint> points, double k) {
    double s0 = 0, sx = 0, sxx = 0, sy = 0, sxy = 0;
    for (const auto& [load, ms] : points) {
        const double w = 1 / (ms * ms), x = std::pow(load, k);
        s0 += w;
        sx += w * x;
        sxx += w * x * x;
        sy += w * ms;
        sxy += w * x * ms;
    }
    Line line;
    const double determinant = s0 * sxx - sx * sx;
    line.a = (sxx * sy - sx * sxy) / determinant;
    line.b = (s0 * sxy - sx * sy) / determinant;
    if (!(line.a > 0)) {
        line.a = 0;
        line.b = sxy / sxx;
    }
    for (const auto& [load, ms] : points) {
        const double residual = (ms - line.a - line.b * std::pow(load, k)) / ms;
        line.squares += residual * residual;
    }
    return line;
}

/// The exponent that minimises Σ residual²: a scan, then a golden-section search around its best point.
double bestExponent(std::span<const CostPoint> points) {
    const auto squares = [&](double k) { return fitLine(points, k).squares; };
    constexpr double step = 0.05;
    double best = minimumExponent;
    for (double k = minimumExponent; k <= maximumExponent; k += step)
        if (squares(k) < squares(best)) best = k;
    double low = std::max(minimumExponent, best - step), high = std::min(maximumExponent, best + step);
    constexpr double golden = 0.6180339887498949;
    while (high - low > 1e-9) {
        const double left = high - golden * (high - low), right = low + golden * (high - low);
        if (squares(left) < squares(right))
            high = right;
        else
            low = left;
    }
    return (low + high) / 2;
}

/// Σ residual² of the best constant.
double squaresOfConstant(std::span<const CostPoint> points) {
    double s0 = 0, sy = 0, squares = 0;
    for (const auto& [load, ms] : points) {
        s0 += 1 / (ms * ms);
        sy += 1 / ms;
    }
    for (const auto& [load, ms] : points) squares += (1 - sy / s0 / ms) * (1 - sy / s0 / ms);
    return squares;
}

/// F test at 5 %: whether the two extra parameters explain more than scatter.
bool growthIsResolved(double constant, double curve, double freedom) {
    constexpr double roundOff = 1e-20;
    if (freedom < 1 || constant < roundOff * freedom) return false;
    const double quantile = boost::math::quantile(boost::math::fisher_f(2, freedom), intervalConfidence);
    return constant - curve > 2 * quantile * curve / freedom;
}

int sign(double value) {
    return (value > 0) - (value < 0);
}

}  // namespace

CostFit fitCost(std::span<const CostPoint> points) {
    CostFit fit;
    fit.runs = points.size();
    std::set<double> loads;
    for (const auto& [load, ms] : points) {
        loads.insert(load);
        if (!(load > 0 && std::isfinite(load))) fit.reason = "a load is not a number above 0";
        if (!(ms > 0 && std::isfinite(ms))) fit.reason = "a time is not a number above 0";
    }
    fit.loads = loads.size();
    if (fit.reason.empty() && loads.size() < minimumLoads) fit.reason = "fewer than 4 different loads";
    if (!fit.reason.empty()) return fit;

    const double k = bestExponent(points);
    const Line line = fitLine(points, k);
    const double margin = 1e-3;
    const bool withFixed = line.a > 0;
    const auto freedom = static_cast<double>(points.size()) - (withFixed ? 3 : 2);
    if (!growthIsResolved(squaresOfConstant(points), line.squares, freedom)) {
        fit.reason = "any growth with the load is within the scatter";
        return fit;
    }
    if (!(line.b > 0) || k < minimumExponent + margin || k > maximumExponent - margin) {
        fit.reason = "the cost does not grow as a power of the load";
        return fit;
    }
    fit.fixedMs.value = line.a;
    fit.factor.value = line.b;
    fit.exponent.value = k;

    glm::dmat3 normal(0);  // JᵀJ in the order a, b, k
    for (const auto& [load, ms] : points) {
        const double x = std::pow(load, k);
        const glm::dvec3 gradient = glm::dvec3(withFixed ? 1 : 0, x, line.b * x * std::log(load)) / ms;
        normal += glm::outerProduct(gradient, gradient);
    }
    if (!withFixed) normal[0][0] = 1;
    fit.relativeError = std::sqrt(line.squares / freedom);

    // Scaled to a unit diagonal before inversion, since the three parameters differ by orders of magnitude.
    glm::dvec3 scale;
    for (int i = 0; i < 3; ++i) scale[i] = 1 / std::sqrt(normal[i][i]);
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j) normal[i][j] *= scale[i] * scale[j];
    const glm::dmat3 inverse = glm::inverse(normal);
    const double t = studentQuantile((1 + intervalConfidence) / 2, freedom);
    const auto plusMinus = [&](int i) { return t * fit.relativeError * std::sqrt(inverse[i][i]) * scale[i]; };
    if (withFixed) fit.fixedMs.plusMinus = plusMinus(0);
    fit.factor.plusMinus = plusMinus(1);
    fit.exponent.plusMinus = plusMinus(2);
    return fit;
}

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

}  // namespace dustbench::measure
