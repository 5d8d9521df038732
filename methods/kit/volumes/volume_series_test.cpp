#include "methods/kit/volumes/volume_series.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <numeric>

#include "methods/kit/testing/test_folder.h"

namespace dustbench::volumes {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

const std::vector<std::filesystem::path> names{"a.vdb", "b.vdb", "c.vdb"};

VolumeGrid filled(const glm::ivec3& cells, const glm::dvec3& origin, double time, float density) {
    VolumeGrid grid;
    grid.cells = cells;
    grid.origin = origin;
    grid.spacing = 0.5;
    grid.timeSeconds = time;
    grid.density.assign(grid.cellCount(), density);
    return grid;
}

double massOf(const VolumeGrid& grid) {
    return std::accumulate(grid.density.begin(), grid.density.end(), 0.0) * std::pow(grid.spacing, 3);
}

std::vector<std::filesystem::path> first(std::size_t count) {
    return {names.begin(), names.begin() + static_cast<std::ptrdiff_t>(count)};
}

TEST(VolumeSeries, BetweenTwoMomentsEveryCellChangesEvenlyWhereverTheirBoxesLie) {
    // Two cells, and two others of which one is the same.
    VolumeGrid from = filled({2, 1, 1}, {0, 0, 0}, 3, 4), to = filled({2, 1, 1}, {0.5, 0, 0}, 5, 8);
    from.velocity.assign(2, {1, 0, 0});
    to.velocity.assign(2, {3, 0, 0});
    const VolumeSeries series({from, to}, first(2));
    EXPECT_EQ(series.seconds(), 2);
    VolumeGrid between;
    const VolumeGrid& shown = series.at(0.5, true, between);
    EXPECT_EQ(shown.cells, glm::ivec3(3, 1, 1));
    EXPECT_EQ(shown.origin, glm::dvec3(0));
    EXPECT_THAT(shown.density, ElementsAre(3, 5, 2));
    EXPECT_EQ(shown.velocity[1], glm::vec3(1.5f, 0, 0));
    EXPECT_DOUBLE_EQ(massOf(shown), 0.75 * massOf(from) + 0.25 * massOf(to));
    // At the moments, before and after them: the moments themselves.
    for (const double seconds : {-1.0, 0.0, 5e-6}) EXPECT_EQ(&series.at(seconds, true, between), &series.moments()[0]);
    for (const double seconds : {2.0, 2 - 5e-6, 9.0})
        EXPECT_EQ(&series.at(seconds, true, between), &series.moments()[1]);
}

TEST(VolumeSeries, OneMomentAloneLasts) {
    VolumeGrid still = filled({2, 2, 2}, {0, 0, 0}, 0, 1), between;
    still.timeSeconds.reset();
    const VolumeSeries series({still}, first(1));
    EXPECT_TRUE(series.isStill());
    EXPECT_EQ(&series.at(100, false, between), &series.moments()[0]);
}

TEST(VolumeSeries, RefusesTimesThatDoNotRiseAndOtherLattices) {
    const auto one = filled({2, 2, 2}, {0, 0, 0}, 0, 1);
    const auto refusal = [&](VolumeGrid next) {
        return inputError([&] { const VolumeSeries series({one, std::move(next)}, first(2)); });
    };
    EXPECT_THAT(refusal(filled({2, 2, 2}, {0, 0, 0}, 0, 1)), HasSubstr("b.vdb: its time is 0 s, expected more than 0"));
    EXPECT_THAT(refusal(filled({2, 2, 2}, {0.2, 0, 0}, 1, 1)), HasSubstr("b.vdb: is on a different grid from a.vdb"));
    EXPECT_THAT(refusal(filled({2, 2, 2}, {1e6, 1e6, 1e6}, 1, 1)), HasSubstr("256000000 cells (limit of volumes)"));
    VolumeGrid timeless = one;
    timeless.timeSeconds.reset();
    EXPECT_THAT(refusal(timeless), HasSubstr("b.vdb: has no time, expected TimeValue"));
}

TEST(VolumeSeries, AGridWithZUpIsTurnedAndPlaced) {
    VolumeGrid grid = filled({2, 3, 4}, {1, 2, 3}, 0, 0);
    grid.velocity.assign(grid.cellCount(), {1, 2, 3});
    grid.density[grid.indexOf({1, 0, 3})] = 5;  // its middle at (1.75, 2.25, 4.75)
    VolumeSetup setup;
    setup.zUp = true;
    setup.metresPerUnit = 2;
    setup.position = {10, 0, 0};
    placeInWorld(grid, setup);
    EXPECT_EQ(grid.cells, glm::ivec3(2, 4, 3));
    EXPECT_EQ(grid.spacing, 1);
    const glm::dvec3 expected(10 + 2 * 1.75, 2 * 4.75, -2 * 2.25);
    const glm::ivec3 cell(glm::floor((expected - grid.origin) / grid.spacing));
    EXPECT_EQ(grid.density[grid.indexOf(cell)], 5);
    EXPECT_EQ(glm::distance(expected, grid.origin + grid.spacing * (glm::dvec3(cell) + 0.5)), 0);
    EXPECT_EQ(grid.velocity[0], glm::vec3(2, 6, -4));
}

/// A file of one cell in the text form of VTK.
std::string oneCell(float density) {
    return "<VTKFile type=\"ImageData\" version=\"1.0\" byte_order=\"LittleEndian\"><ImageData WholeExtent=\"0 1 0 1 0 "
           "1\" Origin=\"0 0 0\" Spacing=\"1 1 1\"><Piece Extent=\"0 1 0 1 0 1\"><CellData><DataArray type=\"Float32\" "
           "Name=\"density\" format=\"ascii\">" +
           std::to_string(density) + "</DataArray></CellData></Piece></ImageData></VTKFile>";
}

TEST(VolumeSeries, FilesWithoutTimesTakeThemFromTheSetupOrFromTheSeriesThatNamesThem) {
    const TestFolder folder;
    for (int i = 0; i < 3; ++i) (void)folder.write("f" + std::to_string(i) + ".vti", oneCell(static_cast<float>(i)));
    const auto setup = folder.write("s.toml", "files = \"f*.vti\"\nseconds_per_file = 0.25\n");
    EXPECT_EQ(VolumeSeries::read(readVolumeSetup(setup)).seconds(), 0.5);
    const auto series =
        folder.write("s.series", R"({"files": [{"name": "f0.vti", "time": 1}, {"name": "f2.vti", "time": 4}]})");
    const VolumeSeries listed = VolumeSeries::read(readVolumeSetup(series));
    EXPECT_EQ(listed.seconds(), 3);
    EXPECT_THAT(listed.moments()[1].density, ElementsAre(2));
    EXPECT_THAT(inputError([&] { (void)VolumeSeries::read(readVolumeSetup(folder.path() / "f*.vti")); }),
                HasSubstr("f0.vti: has no time"));
}

TEST(VolumeSetup, FaultsAreNamedWithTheirLines) {
    const TestFolder folder;
    const auto refusal = [&](const std::string& text) {
        const auto file = folder.write("v.toml", text);
        return inputError([&] { (void)readVolumeSetup(file); });
    };
    EXPECT_THAT(refusal("scale = 2\n"), HasSubstr("files"));
    EXPECT_THAT(refusal("files = \"a.vdb\"\nup = \"x\"\n"), HasSubstr("v.toml:2: key 'up'"));
    EXPECT_THAT(refusal("files = \"a.vdb\"\nlock = 1\n"), HasSubstr("lock"));
    EXPECT_THAT(refusal("files = \"a.vdb\"\n[look]\nfire = \"f.toml\"\n"), HasSubstr("cold"));
    EXPECT_THAT(refusal("files = \"a.vdb\"\n[look]\nfire = \"f.toml\"\ncold = 5\nhot = 5\n"),
                HasSubstr("v.toml:5: key 'hot': got 5, expected more than 5"));
    EXPECT_THAT(refusal("files = \"a.vdb\"\n[look]\nalbedo = [1, 2, 0]\n"), HasSubstr("key 'albedo': got 2"));
}

}  // namespace
}  // namespace dustbench::volumes
