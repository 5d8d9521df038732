// The mean of several rounds or seeds as a finding, with Student's 95 % interval. Threads: pure.
#pragma once

#include <array>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "methods/contract/experiment.h"

namespace dustbench::relief {

/// Of 2 to 10 values.
[[nodiscard]] inline Finding meanOf(std::string quantity, const std::vector<double>& values) {
    constexpr std::array t95{12.706, 4.303, 3.182, 2.776, 2.571, 2.447, 2.365, 2.306, 2.262};  // n − 1 from 1 on
    const auto n = static_cast<double>(values.size());
    double mean = 0, squares = 0;
    for (const double value : values) mean += value / n;
    for (const double value : values) squares += (value - mean) * (value - mean);
    const double half = t95.at(values.size() - 2) * std::sqrt(squares / (n - 1) / n);
    return {std::move(quantity), mean, mean - half, mean + half, static_cast<std::int64_t>(values.size())};
}

}  // namespace dustbench::relief
