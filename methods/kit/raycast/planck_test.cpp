#include "methods/kit/raycast/planck.h"

#include <gtest/gtest.h>

#include <cmath>

#include "methods/kit/testing/test_folder.h"

namespace dustbench::raycast {
namespace {

glm::dvec2 chromaticity(double kelvin) {
    const glm::dvec3 xyz = blackBody(kelvin);
    return glm::dvec2(xyz) / (xyz.x + xyz.y + xyz.z);
}

TEST(Planck, HasTheChromaticitiesOfTheBlackBodysLocus) {
    // CIE illuminant A is a black body of 2,856 K; the others are points of the Planckian locus.
    const std::pair<double, glm::dvec2> known[]{
        {1500, {0.5857, 0.3931}}, {2856, {0.44757, 0.40745}}, {4000, {0.3805, 0.3768}}, {6500, {0.3135, 0.3237}}};
    for (const auto& [kelvin, xy] : known) {
        // The sums of Gaussians differ from the tables by up to 0.0045, most in deep red.
        EXPECT_NEAR(chromaticity(kelvin).x, xy.x, 0.005) << kelvin;
        EXPECT_NEAR(chromaticity(kelvin).y, xy.y, 0.005) << kelvin;
    }
}

TEST(Planck, LuminanceGrowsAsWiensLawSaysWhereItsLimitHolds) {
    // For c₂/λT ≫ 1, ln Y falls by c₂/λ·(1/T₁ − 1/T₂), with λ between 550 and 650 nm for an eye that sees red light.
    const double ratio = std::log(blackBody(1800).y / blackBody(1200).y), inverse = 1 / 1200.0 - 1 / 1800.0;
    EXPECT_GT(ratio, 1.4387769e7 / 650 * inverse);
    EXPECT_LT(ratio, 1.4387769e7 / 550 * inverse);
}

TEST(Planck, FireHasItsLuminanceAtItsHottestAndNoneWhereItIsCold) {
    const PlanckFire settings{.coldKelvin = 700, .hotKelvin = 2400, .luminance = 5};
    const TransferFunction fire = transferFunctionOf(settings);
    const auto luminance = [&](double reaction) {
        return glm::dot(glm::vec3(fire.at(reaction)), glm::vec3(0.2126f, 0.7152f, 0.0722f));
    };
    EXPECT_NEAR(luminance(1), 5, 1e-3);
    EXPECT_LT(luminance(0), 1e-4);
    for (int i = 0; i < 100; ++i) {
        const double reaction = i / 100.0;
        const glm::vec4 light = fire.at(reaction);
        EXPECT_LE(luminance(reaction), luminance(reaction + 0.01)) << reaction;
        EXPECT_GE(light.r, light.g);
        EXPECT_GE(light.g, light.b);
        EXPECT_NEAR(light.a, 1 - 0.6 * reaction, 1e-5);
    }
}

TEST(Planck, IsReadFromAFileThatHasNoRows) {
    const TestFolder folder;
    const auto file = folder.write("p.toml", "[planck]\nhot_kelvin = 2000\nluminance = 2\nfresh_extinction = 0.5\n");
    const TransferFunction fire = loadTransferFunction(file),
                           same = transferFunctionOf({.hotKelvin = 2000, .luminance = 2, .freshExtinction = 0.5f});
    for (const double reaction : {0.0, 0.3, 1.0}) EXPECT_EQ(fire.at(reaction), same.at(reaction));
    const auto message = [&](const std::string& text) {
        const auto bad = folder.write("bad.toml", text);
        return inputError([&] { (void)loadTransferFunction(bad); });
    };
    EXPECT_NE(message("[planck]\n[[row]]\nreaction = 0\nemission = [0, 0, 0]\n").find("either [planck] or [[row]]"),
              std::string::npos);
    EXPECT_NE(message("[planck]\ncold_kelvin = 1900\nhot_kelvin = 1800\n").find("hot_kelvin"), std::string::npos);
    EXPECT_NE(message("[planck]\nkelvin = 1900\n").find("kelvin"), std::string::npos);
}

}  // namespace
}  // namespace dustbench::raycast
