#include "methods/kit/raycast/transfer_function.h"

#include <gtest/gtest.h>

#include <cmath>

#include "methods/kit/raycast/raycast_settings.h"
#include "methods/kit/raycast/shown_grid.h"
#include "methods/kit/testing/test_folder.h"

namespace dustbench::raycast {
namespace {

using Row = TransferFunction::Row;

TEST(TransferFunction, GoesLinearlyBetweenRowsAndStaysBeyondThem) {
    const TransferFunction fire({{0.25, {0, 1, 0}, 2}, {0.5, {4, 2, 1}, 1}});
    EXPECT_EQ(fire.at(0), glm::vec4(0, 1, 0, 2));
    EXPECT_EQ(fire.at(0.375), glm::vec4(2, 1.5, 0.5, 1.5));
    EXPECT_EQ(fire.at(0.5), glm::vec4(4, 2, 1, 1));
    EXPECT_EQ(fire.at(1), glm::vec4(4, 2, 1, 1));
    const auto table = fire.table();
    ASSERT_EQ(table.size(), 256u);
    EXPECT_EQ(table.front(), fire.at(0));
    EXPECT_EQ(table[100], fire.at(100.0 / 255));
}

TEST(TransferFunction, OfNoFileIsDarkWhereBurntOutAndGlowsWhereFresh) {
    const TransferFunction fire;
    EXPECT_EQ(fire.at(0), glm::vec4(0, 0, 0, 1));
    EXPECT_GT(fire.at(1).r, 1);
}

TEST(TransferFunction, RefusesRowsThatMakeNoTable) {
    const Row low{0.2, {0, 0, 0}, 1}, high{0.8, {1, 1, 1}, 1};
    EXPECT_EQ(inputError([&] { TransferFunction({low}); }), "transfer function: got 1 row, allowed: 2 or more");
    EXPECT_NE(inputError([&] {
                  TransferFunction({high, low});
              }).find("row 2: got a reaction of 0.2"),
              std::string::npos);
    EXPECT_THROW(TransferFunction({low, low}), InputError);
    for (const Row& bad : {Row{1.1, {0, 0, 0}, 1}, Row{std::nan(""), {0, 0, 0}, 1}, Row{0.9, {-1, 0, 0}, 1},
                           Row{0.9, {0, std::nanf(""), 0}, 1}, Row{0.9, {0, 0, 0}, -1}})
        EXPECT_THROW(TransferFunction({low, bad}), InputError);
}

TEST(TransferFunction, IsReadFromAFileAndItsMistakesAreNamedByLine) {
    const TestFolder folder;
    const auto good = folder.write("fire.toml",
                                   "[[row]]\nreaction = 0.0\nemission = [0, 0, 0]\n\n"
                                   "[[row]]\nreaction = 1.0\nemission = [4, 2, 1]\nextinction = 0.5\n");
    EXPECT_EQ(loadTransferFunction(good).at(0.5), glm::vec4(2, 1, 0.5, 0.75));
    const auto lineOf = [&](const char* text) {
        const auto file = folder.write("bad.toml", text);
        const std::string message = inputError([&] { (void)loadTransferFunction(file); });
        const std::size_t name = message.find("bad.toml:");
        EXPECT_NE(name, std::string::npos) << message;
        return std::stoi(message.substr(name + 9));
    };
    const std::string row = "[[row]]\nreaction = 0.5\nemission = [0, 0, 0]\n";
    EXPECT_EQ(lineOf((row + "[[row]]\nreaction = 0.4\nemission = [0, 0, 0]\n").c_str()), 4);
    EXPECT_EQ(lineOf((row + "[[row]]\nreaction = 1.5\nemission = [0, 0, 0]\n").c_str()), 5);
    EXPECT_EQ(lineOf((row + "[[row]]\nreaction = nan\nemission = [0, 0, 0]\n").c_str()), 5);
    EXPECT_EQ(lineOf((row + "[[row]]\nreaction = 0.9\nemission = [0, -1, 0]\n").c_str()), 4);
    EXPECT_EQ(lineOf((row + "[[row]]\nreaction = 0.9\nemission = [0, 0]\n").c_str()), 6);
    EXPECT_EQ(lineOf((row + "[[row]]\nreaction = 0.9\nemission = [0, 0, 0]\ncolour = 1\n").c_str()), 7);
    EXPECT_NE(inputError([&] { (void)loadTransferFunction(folder.write("bad.toml", row)); }).find("got 1 row"),
              std::string::npos);
    EXPECT_NE(inputError([&] { (void)loadTransferFunction(folder.write("bad.toml", "")); }).find("got 0 rows"),
              std::string::npos);
}

TEST(ShownGrid, RefusesWhatIsNoGrid) {
    const std::vector<float> values(24);
    const ShownGrid good{{2, 3, 4}, 0.5, {0, 0, 0}, values, {}};
    check(good);
    const auto refuses = [&](auto change) {
        ShownGrid bad = good;
        change(bad);
        EXPECT_THROW(check(bad), InputError);
    };
    refuses([](ShownGrid& grid) { grid.cells.y = 0; });
    refuses([](ShownGrid& grid) { grid.cells.y = 4; });
    refuses([](ShownGrid& grid) { grid.cells = {24, 1, 5000}; });
    refuses([](ShownGrid& grid) { grid.spacingMetres = 0; });
    refuses([](ShownGrid& grid) { grid.spacingMetres = std::nan(""); });
    refuses([](ShownGrid& grid) { grid.originMetres.z = std::nan(""); });
    refuses([](ShownGrid& grid) { grid.reaction = grid.density.first(23); });
}

TEST(RaycastSettings, RefuseValuesOutOfRange) {
    check(RaycastSettings{});
    const auto refuses = [](auto change) {
        RaycastSettings bad;
        change(bad);
        EXPECT_THROW(check(bad), InputError);
    };
    refuses([](RaycastSettings& settings) { settings.stepCells = 0; });
    refuses([](RaycastSettings& settings) { settings.stepCells = std::nan(""); });
    refuses([](RaycastSettings& settings) {
        settings.backend = Backend::cpu;
        settings.renderer = Renderer::slices;
    });
    refuses([](RaycastSettings& settings) { settings.shadowCells = -1; });
    refuses([](RaycastSettings& settings) { settings.stopAlpha = 1.5; });
    refuses([](RaycastSettings& settings) { settings.extinctionPerMetre = -1; });
    refuses([](RaycastSettings& settings) { settings.smokeColour.g = 2; });
}

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
