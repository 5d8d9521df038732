// Tests the choice of the density among several fields by name, at cells or points. If two fields match, the file is
// refused and both are named.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "methods/kit/testing/test_folder.h"
#include "methods/kit/volumes/openvdb/test_grids.h"
#include "methods/kit/volumes/volume_file.h"

namespace dustbench::volumes {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

struct Array {
    const char *type, *name, *numbers;
    int components = 1;
};

/// Three cells in a row and the 16 points around them.
std::string row(const std::vector<Array>& cells, const std::vector<Array>& points) {
    const auto arrays = [](const char* place, const std::vector<Array>& list) {
        std::string text = std::string("<") + place + ">";
        for (const Array& each : list)
            text += std::string("<DataArray type=\"") + each.type + "\" Name=\"" + each.name +
                    "\" NumberOfComponents=\"" + std::to_string(each.components) + "\" format=\"ascii\">" +
                    each.numbers + "</DataArray>";
        return text + "</" + place + ">";
    };
    return R"(<VTKFile type="ImageData" version="1.0" byte_order="LittleEndian">
<ImageData WholeExtent="0 3 0 1 0 1" Origin="0 0 0" Spacing="1 1 1"><Piece Extent="0 3 0 1 0 1">)" +
           arrays("PointData", points) + arrays("CellData", cells) + "</Piece></ImageData></VTKFile>";
}

constexpr const char* sixteen = "1 2 3 4 5 6 7 8 9 10 11 12 13 14 15 16";
constexpr const char* sixteenZeros = "0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0";

VolumeGrid readRow(const TestFolder& folder, const std::vector<Array>& cells, const std::vector<Array>& points,
                   const VolumeFields& fields = {}) {
    return readVolume(folder.write("row.vti", row(cells, points)), fields);
}

std::string rowRefusal(const TestFolder& folder, const std::vector<Array>& cells, const std::vector<Array>& points,
                       const VolumeFields& fields = {}) {
    return inputError([&] { (void)readRow(folder, cells, points, fields); });
}

TEST(WhichField, DensityAtThePointsIsFoundBesideAnyArrayOfTheCells) {
    const TestFolder folder;
    const Array density{"Float32", "density", sixteen};
    for (const Array& other : {Array{"UInt8", "vtkGhostType", "0 0 0"}, Array{"Int32", "material", "3 3 3"},
                               Array{"Float32", "temperature", "300 300 300"}}) {
        const VolumeGrid read = readRow(folder, {other}, {density});
        EXPECT_EQ(read.cells, glm::ivec3(4, 2, 2)) << other.name;
        EXPECT_EQ(read.density[15], 16) << other.name;
        EXPECT_TRUE(read.temperature.empty()) << other.name;
    }
    VolumeFields named;
    named.density = "soot";
    EXPECT_EQ(readRow(folder, {{"Float32", "density", "1 1 1"}}, {{"Float32", "soot", sixteen}}, named).density[3], 4);
    EXPECT_EQ(readRow(folder, {{"UInt8", "vtkGhostType", "0 0 0"}, {"UInt8", "avtGhostZones", "0 0 0"}},
                      {{"Int64", "vtkOriginalPointIds", sixteen}, {"Float64", "rho", sixteen}})
                  .density[2],
              3);
}

TEST(WhichField, TwoCandidatesAreRefusedAndNamed) {
    const TestFolder folder;
    const Array cells{"Float32", "density", "1 2 3"}, points{"Float32", "density", sixteen};
    EXPECT_THAT(rowRefusal(folder, {cells}, {points}), HasSubstr("density (at cells), density (at points)"));
    VolumeFields named;
    named.density = "density";
    EXPECT_THAT(rowRefusal(folder, {cells}, {points}, named), HasSubstr("density (at cells), density (at points)"));
    named.density = "density (at cells)";
    EXPECT_THAT(readRow(folder, {cells}, {points}, named).density, ElementsAre(1, 2, 3));
    named.density = "density (at points)";
    EXPECT_EQ(readRow(folder, {cells}, {points}, named).density[15], 16);
    EXPECT_THAT(rowRefusal(folder, {cells}, {}, named), HasSubstr("no field of numbers 'density (at points)'"));
    named.density = "density";
    EXPECT_THAT(rowRefusal(folder, {{"Float32", "smoke", "1 2 3"}, cells}, {}), HasSubstr("smoke, density"));
    EXPECT_THAT(rowRefusal(folder, {{"Int32", "material", "1 2 3"}}, {{"Float32", "rho", sixteen}}),
                HasSubstr("it has: material, rho"));
    named.temperature = "heat";
    named.wantsTemperature = true;
    EXPECT_THAT(rowRefusal(folder, {cells}, {{"Float32", "heat", sixteen}}, named),
                HasSubstr("its field 'heat' is at points, but its density is at cells"));
}

TEST(WhichField, CellsAndPointsThatVtkMarksDoNotCount) {
    const TestFolder folder;
    const Array density{"Float32", "density", "1 2 3"}, points{"Float32", "density", sixteen};
    for (const char* marks : {"0 32 0", "0 8 0", "0 1 0", "0 33 0"})
        EXPECT_THAT(readRow(folder, {density, {"UInt8", "vtkGhostType", marks}}, {}).density, ElementsAre(1, 0, 3));
    EXPECT_THAT(readRow(folder, {density, {"UInt8", "vtkGhostType", "0 2 16"}}, {}).density, ElementsAre(1, 2, 3));
    EXPECT_THAT(readRow(folder, {density, {"UInt8", "vtkGhostLevels", "0 0 2"}}, {}).density, ElementsAre(1, 2, 0));
    // A hidden point, the first, hides its cell; a duplicate one does not.
    EXPECT_THAT(readRow(folder, {density}, {{"UInt8", "vtkGhostType", "2 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0"}}).density,
                ElementsAre(0, 2, 3));
    EXPECT_THAT(readRow(folder, {density}, {{"UInt8", "vtkGhostType", "1 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0"}}).density,
                ElementsAre(1, 2, 3));
    // The first cell's points are hidden with it, except those of the second cell; so are marked points.
    const VolumeGrid read = readRow(folder, {{"UInt8", "vtkGhostType", "32 0 0"}},
                                    {points, {"UInt8", "vtkGhostType", "0 0 0 1 0 0 0 0 0 0 0 0 0 0 0 2"}});
    EXPECT_THAT(read.density, ElementsAre(0, 2, 3, 0, 0, 6, 7, 8, 0, 10, 11, 12, 0, 14, 15, 0));
    // Hidden cells may have invalid densities.
    EXPECT_THAT(readRow(folder, {{"Float32", "density", "1 -9 3"}, {"UInt8", "vtkGhostType", "0 32 0"}}, {}).density,
                ElementsAre(1, 0, 3));
}

TEST(WhichField, VectorsAreFoundAtThePointsToo) {
    const TestFolder folder;
    const std::string numbers = std::string(sixteen) + " " + sixteenZeros + " " + sixteen;
    const VectorGrid read = readVectors(
        folder.write("wind.vti", row({{"UInt8", "vtkGhostType", "0 0 0"}}, {{"Float32", "wind", numbers.c_str(), 3}})),
        "wind");
    EXPECT_EQ(read.cells, glm::ivec3(4, 2, 2));
    EXPECT_EQ(read.origin, glm::dvec3(-0.5));
    EXPECT_EQ(read.values[1], glm::vec3(4, 5, 6));
}

template <typename Value>
TestGrid<Value> gridOfOneCell(const char* name, const Value& value) {
    TestGrid<Value> grid(name);
    grid.set({0, 0, 0}, value);
    return grid;
}

TEST(WhichField, TwoVdbGridsOfANameAreRefused) {
    const TestFolder folder;
    const std::string file = folder.path() / "a.vdb";
    const auto refusal = [&](const std::vector<AnyTestGrid>& grids) {
        writeVdb(file, grids);
        return inputError([&] { (void)readVolume(file, {}); });
    };
    const auto one = gridOfOneCell<float>("density", 1), two = gridOfOneCell<float>("density", 2);
    EXPECT_THAT(refusal({one, two}), HasSubstr("density (grid 1 of float), density (grid 2 of float)"));
    VolumeFields second;
    second.density = "density (grid 2 of float)";
    EXPECT_THAT(readVolume(file, second).density, ElementsAre(2));
    EXPECT_THAT(refusal({one, gridOfOneCell<float>("smoke", 1)}), HasSubstr("density, smoke"));
    EXPECT_THAT(refusal({one, gridOfOneCell<glm::vec3>("v", {}), gridOfOneCell<glm::vec3>("vel", {})}),
                HasSubstr("more than one field of vectors for its velocity: v, vel"));
    EXPECT_THAT(refusal({gridOfOneCell<float>("", 1), gridOfOneCell<float>("", 1)}),
                HasSubstr("it has: (no name) (grid 1 of float), (no name) (grid 2 of float)"));
    EXPECT_THAT(refusal({gridOfOneCell<int>("density", 1)}),
                HasSubstr("'density' (grid 1 of int32) does not contain one floating-point number per cell"));
    writeVdb(file, {gridOfOneCell<glm::vec3>("wind", {1, 2, 3}), gridOfOneCell<glm::vec3>("wind", {4, 5, 6})});
    EXPECT_THAT(inputError([&] { (void)readVectors(file, "wind"); }),
                HasSubstr("wind (grid 1 of vec3s), wind (grid 2"));
}

TEST(VdbTime, IsAFloatOrADouble) {
    const TestFolder folder;
    const std::string file = folder.path() / "a.vdb";
    const auto expectTime = [&](auto time, double seconds) {
        auto grid = gridOfOneCell<float>("density", 1);
        grid.setTime(time);
        writeVdb(file, {grid});
        EXPECT_EQ(readVolume(file, {}).timeSeconds, seconds);
    };
    expectTime(0.25f, 0.25);
    expectTime(0.1, 0.1);
}

}  // namespace
}  // namespace dustbench::volumes
