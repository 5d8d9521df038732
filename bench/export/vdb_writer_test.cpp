// OpenVDB's own Python module reads back what was written.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <sstream>

#include "bench/export/format_writers.h"
#include "bench/export/test_clouds.h"
#include "methods/kit/testing/python_script.h"

namespace dustbench::exports {
namespace {

/// Prints name=value lines: metadata, the sum over the voxels, and the sum of each world coordinate times the value.
constexpr const char* describe = R"(
import sys
import pyopenvdb as vdb
grid, = vdb.readAllGridMetadata(sys.argv[1])
print('name=' + grid.name)
print('class=' + grid.gridClass)
print('half=' + str(grid.metadata['is_saved_as_half_float'] if 'is_saved_as_half_float' in grid.metadata else grid.saveFloatAsHalf))
print('time=' + repr(grid.metadata['time_s']))
print('frame=' + repr(grid.metadata['frame']))
grid = vdb.read(sys.argv[1], 'density')
print('background=' + repr(grid.background))
print('active=' + repr(grid.activeVoxelCount()))
total = x = y = z = 0.0
for item in grid.iterOnValues():
    low, high = item.min, item.max
    count = (high[0] - low[0] + 1) * (high[1] - low[1] + 1) * (high[2] - low[2] + 1)
    middle = grid.transform.indexToWorld(tuple((a + b) / 2 for a, b in zip(low, high)))
    total += item.value * count
    x += item.value * count * middle[0]
    y += item.value * count * middle[1]
    z += item.value * count * middle[2]
print('sum=' + repr(total))
print('x=' + repr(x)); print('y=' + repr(y)); print('z=' + repr(z))
)";

std::map<std::string, std::string> description(const TestFolder& folder, const std::filesystem::path& file) {
    std::istringstream lines(python(folder, describe, file));
    std::map<std::string, std::string> said;
    for (std::string line; std::getline(lines, line);)
        said[line.substr(0, line.find('='))] = line.substr(line.find('=') + 1);
    return said;
}

class VdbFile : public testing::TestWithParam<VdbPrecision> {};

TEST_P(VdbFile, HasTheSameSumAtTheSamePlaceInTheWorld) {
    const TestFolder folder;
    const double tolerance = GetParam() == VdbPrecision::half ? 1e-3 : 1e-6;
    for (const unsigned seed : {1u, 2u}) {
        const CollectedVolume volume = TestDust(300, 10, 0.1f, seed).volume();
        const ExtinctionGrid grid = computeGrid(volume, planGrid(volume.bounds(), 61));
        writeVdb(grid, GetParam(), 120, 2.0 + 1.0 / 60, folder.path() / "a.vdb");
        double sum = 0;
        glm::dvec3 moment(0);
        std::int64_t filled = 0;
        for (std::int64_t cell = 0; cell < grid.plan.cellCount(); ++cell) {
            const glm::dvec3 index(cell % grid.plan.cells[0], cell / grid.plan.cells[0] % grid.plan.cells[1],
                                   cell / grid.plan.cells[0] / grid.plan.cells[1]);
            const auto value = static_cast<double>(grid.extinctionPerMetre[static_cast<std::size_t>(cell)]);
            sum += value;
            moment += value * (grid.plan.origin + grid.plan.spacingMetres * (index + 0.5));
            filled += value != 0;
        }
        auto said = description(folder, folder.path() / "a.vdb");
        EXPECT_EQ(said["name"], "density");
        EXPECT_EQ(said["class"], "fog volume");
        EXPECT_EQ(said["half"], GetParam() == VdbPrecision::half ? "True" : "False");
        EXPECT_EQ(std::stod(said["time"]), 2.0 + 1.0 / 60);
        EXPECT_EQ(said["frame"], "120");
        EXPECT_EQ(std::stod(said["background"]), 0);
        EXPECT_EQ(said["active"], std::to_string(filled));
        EXPECT_LT(filled, grid.plan.cellCount());  // sparse
        EXPECT_NEAR(std::stod(said["sum"]) / sum, 1, tolerance);
        // The centre of mass, which would reveal a shift by half a cell.
        const glm::dvec3 centre =
            glm::dvec3(std::stod(said["x"]), std::stod(said["y"]), std::stod(said["z"])) / std::stod(said["sum"]);
        EXPECT_LT(glm::distance(centre, moment / sum), 0.01 * grid.plan.spacingMetres);
    }
}

INSTANTIATE_TEST_SUITE_P(Precisions, VdbFile, testing::Values(VdbPrecision::half, VdbPrecision::single),
                         [](const auto& precision) {
                             return precision.param == VdbPrecision::half ? "half" : "float";
                         });

TEST(VdbFileOf, AnEmptyCloudCanBeRead) {
    const TestFolder folder;
    writeVdb(computeGrid({}, planGrid({}, 128)), VdbPrecision::half, 0, 0, folder.path() / "a.vdb");
    auto said = description(folder, folder.path() / "a.vdb");
    EXPECT_EQ(said["name"], "density");
    EXPECT_EQ(said["active"], "0");
}

TEST(VdbFileOf, WhatHalfFloatsCannotHoldIsRefused) {
    const TestFolder folder;
    ExtinctionGrid grid = computeGrid({}, planGrid({}, 1));
    grid.extinctionPerMetre[0] = 70'000;
    EXPECT_THAT(inputError([&] { writeVdb(grid, VdbPrecision::half, 0, 0, folder.path() / "a.vdb"); }),
                testing::AllOf(testing::HasSubstr("70000"), testing::HasSubstr("--vdb-precision float")));
    EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
    writeVdb(grid, VdbPrecision::single, 0, 0, folder.path() / "a.vdb");
    auto said = description(folder, folder.path() / "a.vdb");
    EXPECT_EQ(std::stod(said["sum"]), 70'000);
}

}  // namespace
}  // namespace dustbench::exports
