#include "methods/kit/maths/sampling.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <vector>

#include "methods/kit/maths/philox.h"

namespace dustbench::maths {
namespace {

constexpr int samples = 100000;
// Kolmogorov–Smirnov: for a sample of the stated distribution, D·√n exceeds 1.95 with probability 0.001.
const double criticalDistance = 1.95 / std::sqrt(static_cast<double>(samples));

/// Maximum distance between the sample's distribution and `law`.
double distance(const std::function<double(std::uint64_t)>& sample, const std::function<double(double)>& law) {
    std::vector<double> values(samples);
    for (std::uint64_t i = 0; i < samples; ++i) values[i] = sample(i);
    std::ranges::sort(values);
    double worst = 0;
    for (std::size_t i = 0; i < values.size(); ++i) {
        const double p = law(values[i]);
        worst = std::max({worst, p - static_cast<double>(i) / samples, static_cast<double>(i + 1) / samples - p});
    }
    return worst;
}

double identity(double v) {
    return v;
}

TEST(Disc, IsUniformInRadiusSquaredAndAngle) {
    const auto point = [](std::uint64_t i) {
        const auto u = uniform4(3, 1, i);
        return glm::dvec2(discPoint(u[0], u[1]));
    };
    EXPECT_LT(distance([&](auto i) { return glm::dot(point(i), point(i)); }, identity), criticalDistance);
    EXPECT_LT(
        distance([&](auto i) { return std::atan2(point(i).y, point(i).x) / (2 * std::numbers::pi) + 0.5; }, identity),
        criticalDistance);
}

TEST(Sphere, IsUniformAlongEveryAxis) {
    for (int axis = 0; axis < 3; ++axis)
        EXPECT_LT(distance(
                      [&](auto i) {
                          const auto u = uniform4(4, 1, i);
                          return static_cast<double>(sphereDirection(u[0], u[1])[axis]);
                      },
                      [](double c) { return (c + 1) / 2; }),
                  criticalDistance);
}

TEST(Tangents, MakeARightHandedOrthonormalFrame) {
    for (std::uint64_t i = 0; i < 1000; ++i) {
        const auto u = uniform4(5, 1, i);
        const glm::vec3 axis = sphereDirection(u[0], u[1]);
        const auto [first, second] = tangentsOf(axis);
        EXPECT_NEAR(glm::dot(first, second), 0, 1e-6);
        EXPECT_NEAR(glm::length(first), 1, 2e-6);
        EXPECT_NEAR(glm::length(glm::cross(first, second) - axis), 0, 2e-6);
    }
}

/// Distance of cos β from the uniform distribution on a cap of half angle βmax.
double coneDistance(SamplingMode mode, double halfAngleTurns) {
    const glm::vec3 axis = glm::normalize(glm::vec3(0.3f, 0.8f, -0.5f));
    const dustbench::maths::Cone cone(mode, axis, static_cast<float>(halfAngleTurns));
    const double minimum = std::cos(halfAngleTurns * 2 * std::numbers::pi);
    return distance(
        [&](auto i) {
            const auto u = uniform4(6, 1, i);
            return static_cast<double>(glm::dot(axis, cone.direction(u[0], u[1])));
        },
        [&](double c) { return std::clamp((c - minimum) / (1 - minimum), 0.0, 1.0); });
}

TEST(Cone, FixedIsUniformAtEveryAngle) {
    for (const double degrees : {30.0, 90.0, 180.0})
        EXPECT_LT(coneDistance(SamplingMode::fixed, degrees / 360), criticalDistance) << degrees;
}

// Claim R20: the limits of the paper's distribution are 0.006 at 30° and 0.056 at 90°.
TEST(Cone, PaperIsNotUniformWhereTheConeIsWide) {
    EXPECT_NEAR(coneDistance(SamplingMode::paper, 30.0 / 360), 0.006, criticalDistance);
    EXPECT_NEAR(coneDistance(SamplingMode::paper, 90.0 / 360), 0.056, criticalDistance);
}

TEST(Cone, GivesUnitVectorsWithinItsHalfAngle) {
    const glm::vec3 axis{0, 0, -1};
    for (const auto mode : {SamplingMode::paper, SamplingMode::fixed})
        for (std::uint64_t i = 0; i < 2000; ++i) {
            const auto u = uniform4(8, 1, i);
            const glm::vec3 direction = dustbench::maths::Cone(mode, axis, 40.0f / 360).direction(u[0], u[1]);
            EXPECT_NEAR(glm::length(direction), 1, 2e-6);
            EXPECT_GE(glm::dot(direction, axis), std::cos(40 * std::numbers::pi / 180) - 1e-6);
        }
}

TEST(Cone, OfNoWidthIsItsAxis) {
    const glm::vec3 axis = glm::normalize(glm::vec3(1, 2, 3));
    for (const auto mode : {SamplingMode::paper, SamplingMode::fixed})
        EXPECT_NEAR(glm::length(dustbench::maths::Cone(mode, axis, 0).direction(0.7f, 0.3f) - axis), 0, 1e-6);
}

}  // namespace
}  // namespace dustbench::maths
