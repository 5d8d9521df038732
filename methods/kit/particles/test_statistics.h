// For tests: distances from distributions, each at the level 1e-6.
//
// Source: Massey1951 (Kolmogorov–Smirnov); WilsonHilferty1931 (quantiles of χ²).
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <glm/glm.hpp>
#include <numbers>
#include <vector>

namespace dustbench::particles::test {

/// D exceeds this with probability 1e-6 for a sample of the law: √(ln(2/1e-6)/(2n)).
inline double distanceLimit(std::size_t samples) {
    return std::sqrt(std::log(2 / 1e-6) / (2 * static_cast<double>(samples)));
}

/// Maximum distance between the sample's distribution and `law`.
inline double distance(std::vector<double> values, const std::function<double(double)>& law) {
    std::ranges::sort(values);
    const auto n = static_cast<double>(values.size());
    double worst = 0;
    for (std::size_t i = 0; i < values.size(); ++i) {
        const double p = law(values[i]);
        worst = std::max({worst, p - static_cast<double>(i) / n, static_cast<double>(i + 1) / n - p});
    }
    return worst;
}

inline void expectLaw(const std::vector<double>& values, const std::function<double(double)>& law) {
    ASSERT_GT(values.size(), 1000u);
    EXPECT_LT(distance(values, law), distanceLimit(values.size()));
}

inline void expectUniform(const std::vector<double>& values, double from, double to) {
    expectLaw(values, [=](double v) { return std::clamp((v - from) / (to - from), 0.0, 1.0); });
}

/// χ² exceeds this with probability 1e-6 (z = 4.753).
inline double chiSquareLimit(int freedom) {
    const double k = freedom, ninth = 2 / (9 * k);
    return k * std::pow(1 - ninth + 4.753 * std::sqrt(ninth), 3);
}

/// χ² of directions over 96 cells of equal area, eight bands of equal height times twelve sectors: 95 degrees of
/// freedom.
inline double chiSquareOverSphere(const std::vector<glm::dvec3>& vectors) {
    std::array<double, 96> counts{};
    for (const glm::dvec3& v : vectors) {
        const glm::dvec3 d = glm::normalize(v);
        const int band = std::clamp(static_cast<int>((d.z + 1) * 4), 0, 7);
        const double turns = std::atan2(d.y, d.x) / (2 * std::numbers::pi) + 0.5;
        ++counts[static_cast<std::size_t>(band * 12 + std::clamp(static_cast<int>(turns * 12), 0, 11))];
    }
    const double expected = static_cast<double>(vectors.size()) / 96;
    double sum = 0;
    for (const double count : counts) sum += (count - expected) * (count - expected) / expected;
    return sum;
}

inline void chiSquareOfSphere(const std::vector<glm::dvec3>& vectors) {
    EXPECT_LT(chiSquareOverSphere(vectors), chiSquareLimit(95));
}

}  // namespace dustbench::particles::test
