#include "methods/kit/maths/turbulence.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace dustbench::maths {
namespace {

glm::dvec3 gustAt(const GustField& field, glm::dvec3 p) {
    return field(static_cast<float>(p.x), static_cast<float>(p.y), static_cast<float>(p.z));
}

TEST(ParabolicWave, IsNearTheSineAndHasItsStatedMeanSquare) {
    double squares = 0, worst = 0;
    constexpr int count = 10000;
    for (int i = 0; i < count; ++i) {
        const double turns = (i + 0.5) / count * 3 - 1;
        const double value = static_cast<double>(parabolicWave(static_cast<float>(turns)));
        squares += value * value;
        worst = std::max(worst, std::abs(value - std::sin(2 * 3.14159265358979 * turns)));
    }
    EXPECT_LT(worst, 0.06);
    EXPECT_NEAR(squares / count, 8.0 / 15, 1e-3);
}

TEST(Turbulence, HasNoDivergenceThroughASphere) {
    const GustField field = gustField(1, 4, 2, {}, 0, 9, 1);
    double flux = 0, flow = 0;
    constexpr int rings = 200, segments = 200;
    for (int i = 0; i < rings; ++i)
        for (int j = 0; j < segments; ++j) {
            const double z = (i + 0.5) / rings * 2 - 1, angle = (j + 0.5) / segments * 6.283185307179586;
            const double r = std::sqrt(1 - z * z);
            const glm::dvec3 normal{r * std::cos(angle), r * std::sin(angle), z};
            const double through = glm::dot(normal, gustAt(field, glm::dvec3(2, 1, -3) + 1.3 * normal));
            flux += through;
            flow += std::abs(through);
        }
    EXPECT_GT(flow / (rings * segments), 0.1);
    EXPECT_LT(std::abs(flux) / flow, 1e-4);
}

TEST(Turbulence, HasTheSpeedAskedForOnAverage) {
    const GustField field = gustField(0.7, 4, 2, {}, 0, 9, 1);
    double squares = 0;
    constexpr int side = 60;
    for (int i = 0; i < side * side * side; ++i) {
        const glm::dvec3 at = glm::dvec3(i % side, i / side % side, i / side / side) * 3.17;
        squares += glm::dot(gustAt(field, at), gustAt(field, at));
    }
    EXPECT_NEAR(std::sqrt(squares / (side * side * side)), 0.7, 0.01);
}

TEST(Turbulence, DriftsWithTheWind) {
    const glm::dvec3 wind{2, 0, -1}, at{5, 1, 7};
    // If the period is far longer than the time step, the field is only advected.
    const GustField now = gustField(1, 4, 1e9, wind, 0, 9, 1), later = gustField(1, 4, 1e9, wind, 1.5, 9, 1);
    EXPECT_LT(glm::length(gustAt(later, at + 1.5 * wind) - gustAt(now, at)), 1e-5);
}

}  // namespace
}  // namespace dustbench::maths
