#include "methods/kit/findings/findings.h"

#include <algorithm>
#include <boost/math/distributions/students_t.hpp>
#include <cmath>
#include <numeric>
#include <utility>

namespace dustbench::findings {
namespace {

double meanOf(const std::vector<double>& values) {
    return std::reduce(values.begin(), values.end()) / static_cast<double>(values.size());
}

/// The 0.975-quantile of Student's t distribution.
double student(double degreesOfFreedom) {
    return boost::math::quantile(boost::math::students_t(degreesOfFreedom), 0.975);
}

std::vector<double> logarithmsOf(std::vector<double> values) {
    for (double& value : values) value = std::log(value);
    return values;
}

/// How many of `count` sorted values lie below the median's interval, and as many above it: the largest k with
/// P(B ≤ k) ≤ 0.025, where B is binomial with p = ½.
std::size_t valuesBelowTheInterval(std::size_t count) {
    const auto n = static_cast<double>(count);
    double chance = std::pow(0.5, n), sum = chance;  // P(B = 0), P(B <= below)
    std::size_t below = 0;
    for (std::size_t next = 1; 2 * next < count; ++next) {
        chance *= (n - static_cast<double>(next) + 1) / static_cast<double>(next);
        if (sum > 0.025) break;
        below = next - 1;
        sum += chance;
    }
    return below;
}

}  // namespace

Finding meanOf(std::string quantity, const std::vector<double>& values) {
    const auto n = static_cast<double>(values.size());
    const double mean = meanOf(values);
    double squares = 0;
    for (const double value : values) squares += (value - mean) * (value - mean);
    const double half = student(n - 1) * std::sqrt(squares / (n - 1) / n);
    return {std::move(quantity), mean, mean - half, mean + half, static_cast<std::int64_t>(values.size())};
}

Finding medianOf(std::string quantity, std::vector<double> values) {
    std::ranges::sort(values);
    const std::size_t below = valuesBelowTheInterval(values.size());
    return {std::move(quantity), values[values.size() / 2], values[below], values[values.size() - 1 - below],
            static_cast<std::int64_t>(values.size())};
}

Finding exponentOf(std::string quantity, const std::vector<double>& x, const std::vector<double>& y) {
    const std::vector<double> logX = logarithmsOf(x), logY = logarithmsOf(y);
    const double meanX = meanOf(logX), meanY = meanOf(logY);
    double xx = 0, xy = 0, rest = 0;
    for (std::size_t i = 0; i < x.size(); ++i) {
        xx += (logX[i] - meanX) * (logX[i] - meanX);
        xy += (logX[i] - meanX) * (logY[i] - meanY);
    }
    const double slope = xy / xx;
    for (std::size_t i = 0; i < x.size(); ++i) {
        const double off = logY[i] - meanY - slope * (logX[i] - meanX);
        rest += off * off;
    }
    const double freedom = static_cast<double>(x.size()) - 2;
    const double half = student(freedom) * std::sqrt(rest / freedom / xx);
    return {std::move(quantity), slope, slope - half, slope + half, static_cast<std::int64_t>(x.size())};
}

}  // namespace dustbench::findings
