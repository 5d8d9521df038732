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

}  // namespace
}  // namespace dustbench::raycast
