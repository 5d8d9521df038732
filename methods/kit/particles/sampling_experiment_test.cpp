#include "methods/kit/particles/sampling_experiment.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

namespace dustbench::particles::sampling {
namespace {

constexpr std::int64_t draws = 500'000;

std::map<std::string, Finding> sampled(std::uint64_t seed) {
    std::map<std::string, Finding> byName;
    for (Finding& finding : sampleDirections(seed, draws)) byName[finding.quantity] = finding;
    return byName;
}

/// sup |F(x) − x| for β = a + √u·(b − a), on a fine grid: F(x) = ((β(x) − a)/(b − a))², cos β(x) = cos a − x·(cos a −
/// cos b).
double distanceInCone(double minimumDegrees, double maximumDegrees) {
    const double a = minimumDegrees * std::numbers::pi / 180, b = maximumDegrees * std::numbers::pi / 180;
    double maximum = 0;
    for (int i = 1; i < 10'000; ++i) {
        const double x = i / 10'000.0;
        const double share = (std::acos(std::cos(a) - x * (std::cos(a) - std::cos(b))) - a) / (b - a);
        maximum = std::max(maximum, std::abs(share * share - x));
    }
    return maximum;
}

TEST(SamplingExperiment, IntervalsHoldTheClosedForms) {
    const std::map<std::string, double> truths{{"acceptance", std::numbers::pi / 6},
                                               {"corner_over_face_gaussian", 1},
                                               {"acceptance_disc", std::numbers::pi / 4},
                                               {"acceptance_4d", std::numbers::pi * std::numbers::pi / 32},
                                               {"chi2_per_cell_gaussian", 1},
                                               {"cone30", distanceInCone(0, 30)},
                                               {"cone90", distanceInCone(0, 90)},
                                               {"nested20_30", distanceInCone(20, 30)}};
    int misses = 0;
    std::map<std::string, Finding> found;
    for (const std::uint64_t seed : {1u, 2u}) {
        found = sampled(seed);
        for (const auto& [name, truth] : truths) misses += truth < found.at(name).low || truth > found.at(name).high;
    }
    EXPECT_LE(misses, 1) << "of 16 intervals, of which 5 % miss";
    EXPECT_DOUBLE_EQ(found.at("tries_per_point").value * found.at("acceptance").value, 1);
    // Density increases as the cube of the distance to the cube's surface: 3√3 exactly at the corner, less over a cap.
    EXPECT_GT(found.at("corner_over_face_cube").low, 4);
    EXPECT_LT(found.at("corner_over_face_cube").high, 3 * std::numbers::sqrt3);
    EXPECT_GT(found.at("chi2_per_cell_cube").low, 100);
    for (const char* cone : {"cone30_by_cosine", "cone90_by_cosine", "nested20_30_by_cosine"})
        EXPECT_LT(found.at(cone).value, 0.002) << cone;
}

TEST(SamplingExperiment, IsAFunctionOfItsSeed) {
    const auto valuesOf = [](std::uint64_t seed) {
        std::vector<double> values;
        for (const Finding& finding : sampleDirections(seed, draws)) values.push_back(finding.value);
        return values;
    };
    EXPECT_EQ(valuesOf(1), valuesOf(1));
    EXPECT_NE(valuesOf(1), valuesOf(2));
}

}  // namespace
}  // namespace dustbench::particles::sampling
