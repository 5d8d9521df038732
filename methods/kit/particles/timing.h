// For timing experiments: the median of repetitions, and an exponent fitted to times.
//
// Units: s. Threads: one caller at a time.
#pragma once

#include <time.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "methods/contract/experiment.h"

namespace dustbench::particles {

/// Returns the calling thread's CPU time for `work`: other programs disturb it less than the wall clock.
template <typename Work>
[[nodiscard]] double secondsOf(const Work& work) {
    const auto now = [] {
        timespec time{};
        clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
        return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
    };
    const double begin = now();
    work();
    return now() - begin;
}

/// How many of `count` sorted values lie below the median's 95 % interval, and as many above it: the greatest k with
/// P(B ≤ k) ≤ 0.025, B binomial with a chance of one half. 0 below nine values: minimum and maximum.
[[nodiscard]] inline std::size_t valuesBelowTheInterval(std::size_t count) {
    const auto n = static_cast<double>(count);
    double chance = std::pow(0.5, n), sum = chance;  // of B = 0, of B <= below
    std::size_t below = 0;
    for (std::size_t next = 1; 2 * next < count; ++next) {
        chance *= (n - static_cast<double>(next) + 1) / static_cast<double>(next);
        if (sum > 0.025) break;
        below = next - 1;
        sum += chance;
    }
    return below;
}

/// Returns the median with its 95 % interval by order statistics, whatever the values' distribution.
[[nodiscard]] inline Finding medianOf(std::string quantity, std::vector<double> values) {
    std::ranges::sort(values);
    const std::size_t below = valuesBelowTheInterval(values.size());
    return {std::move(quantity), values[values.size() / 2], values[below], values[values.size() - 1 - below],
            static_cast<std::int64_t>(values.size())};
}

/// Returns b of y = a·xᵇ by least squares of the logarithms, with Student's 95 % interval (n from 3 to 10).
[[nodiscard]] inline Finding exponentOf(std::string quantity, const std::vector<double>& x,
                                        const std::vector<double>& y) {
    constexpr double t95[] = {12.706, 4.303, 3.182, 2.776, 2.571, 2.447, 2.365, 2.306};
    const auto n = static_cast<double>(x.size());
    double meanX = 0, meanY = 0, xx = 0, xy = 0, rest = 0;
    for (std::size_t i = 0; i < x.size(); ++i) {
        meanX += std::log(x[i]) / n;
        meanY += std::log(y[i]) / n;
    }
    for (std::size_t i = 0; i < x.size(); ++i) {
        xx += (std::log(x[i]) - meanX) * (std::log(x[i]) - meanX);
        xy += (std::log(x[i]) - meanX) * (std::log(y[i]) - meanY);
    }
    const double slope = xy / xx;
    for (std::size_t i = 0; i < x.size(); ++i) {
        const double off = std::log(y[i]) - meanY - slope * (std::log(x[i]) - meanX);
        rest += off * off;
    }
    const double half = t95[x.size() - 3] * std::sqrt(rest / (n - 2) / xx);
    return {std::move(quantity), slope, slope - half, slope + half, static_cast<std::int64_t>(x.size())};
}

}  // namespace dustbench::particles
