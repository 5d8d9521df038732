#include "methods/kit/maths/transmittance.h"

#include <gtest/gtest.h>

#include <functional>

namespace dustbench::maths {
namespace {

/// Simpson's rule with `pieces` (even) intervals.
double integral(const std::function<double(double)>& f, double from, double to, int pieces = 4000) {
    const double h = (to - from) / pieces;
    double sum = f(from) + f(to);
    for (int i = 1; i < pieces; ++i) sum += (i % 2 ? 4 : 2) * f(from + i * h);
    return sum * h / 3;
}

TEST(Transmittance, MassIsTheIntegralOfTheExtinction) {
    for (const double opacity : {0.01, 0.25, 0.9, 0.999})
        for (const double radius : {0.25, 1.6}) {
            const double mass = integral(
                [&](double d) { return 4 * std::numbers::pi * d * d * puffExtinctionPerMetre(opacity, radius, d); }, 0,
                8 * radius);
            EXPECT_NEAR(puffMassSquareMetres(opacity, radius) / mass, 1, 1e-9);
        }
}

TEST(Transmittance, RayDepthIsTheIntegralOfTheExtinctionAlongTheRay) {
    for (const double b : {0.0, 0.3, 1.1})
        for (const auto& [t0, t1] : {std::pair{0.0, 5.0}, {2.4, 2.9}, {3.2, 30.0}}) {
            const double tc = 2.5;
            const double depth = integral(
                [&](double t) { return puffExtinctionPerMetre(0.4, 0.8, std::hypot(b, t - tc)); }, t0, t1, 40000);
            EXPECT_NEAR(rayOpticalDepth(0.4, 0.8, b, tc, t0, t1), depth, 1e-9);
        }
}

TEST(Transmittance, WholeRayThroughTheCentreTransmitsOneMinusThePeakOpacity) {
    for (const double opacity : {0.0, 0.25, 0.999})
        EXPECT_NEAR(std::exp(-rayOpticalDepth(opacity, 1, 0, 50, 0, 100)), 1 - opacity, 1e-12);
}

TEST(Transmittance, BillboardEqualsTheWholeRay) {
    for (const double b : {0.0, 0.2, 0.7, 2.0})
        EXPECT_NEAR(billboardOpacity(0.3, 0.6, b), 1 - std::exp(-rayOpticalDepth(0.3, 0.6, b, 50, 0, 100)), 1e-12);
}

TEST(Transmittance, PartsOfARayAddUp) {
    const double whole = rayOpticalDepth(0.5, 1, 0.4, 3, 0, 9);
    EXPECT_NEAR(rayOpticalDepth(0.5, 1, 0.4, 3, 0, 2.7) + rayOpticalDepth(0.5, 1, 0.4, 3, 2.7, 9), whole, 1e-14);
}

// A half-side of 1.5 r (= 3 s) cuts off 1.1 % of the mass, one of r 13.5 %.
TEST(Transmittance, DiscOfOneAndAHalfRadiiHoldsAllButOnePointOneHundredthsOfTheMass) {
    const auto cutOff = [](double halfSide) {
        const double kept = integral(
            [&](double b) { return 2 * std::numbers::pi * b * rayOpticalDepth(0.2, 1, b, 50, 0, 100); }, 0, halfSide);
        return 1 - kept / puffMassSquareMetres(0.2, 1);
    };
    EXPECT_NEAR(cutOff(1.5), 0.0111, 1e-4);
    EXPECT_NEAR(cutOff(1.0), 0.1353, 1e-4);
}

}  // namespace
}  // namespace dustbench::maths
