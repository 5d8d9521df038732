// Tests that volumes made and written by VTK's, OpenVDB's and NanoVDB's own functions are read with all their values,
// and that other files are refused in one line.
#include "methods/kit/volumes/volume_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <vtkDataArray.h>
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkRTAnalyticSource.h>
#include <vtkXMLImageDataWriter.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <glm/gtc/matrix_transform.hpp>
#include <numeric>

#include "methods/kit/testing/test_folder.h"
#include "methods/kit/volumes/openvdb/test_grids.h"

namespace dustbench::volumes {
namespace {

using testing::HasSubstr;

std::string refusalOf(const std::filesystem::path& file, const VolumeFields& fields = {}) {
    return inputError([&] { (void)readVolume(file, fields); });
}

std::string written(const TestFolder& folder, const std::vector<AnyTestGrid>& grids) {
    const std::string path = folder.path() / "a.vdb";
    writeVdb(path, grids);
    return path;
}

/// A sphere from OpenVDB, as the distance to its surface.
TestGrid<float> sphere() {
    TestGrid<float> grid = levelSetSphere(/*radius=*/2, /*centre=*/{1, 2, 3}, /*cellSize=*/0.125f);
    grid.setName("density");
    return grid;
}

TestGrid<float> fog() {
    TestGrid<float> grid = sphere();
    makeFog(grid);
    return grid;
}

float valueAt(const TestGrid<float>& grid, const VolumeGrid& read, const glm::ivec3& cell) {
    return grid.valueAt(read.origin + read.spacing * (glm::dvec3(cell) + 0.5));
}

void expectSame(const TestGrid<float>& grid, const VolumeGrid& read) {
    ASSERT_EQ(read.density.size(), read.cellCount());
    const double sum = grid.sumOfActive();
    EXPECT_NEAR(std::accumulate(read.density.begin(), read.density.end(), 0.0), sum, 1e-6 * sum);
    for (int z = 0; z < read.cells.z; ++z)
        for (int y = 0; y < read.cells.y; ++y)
            for (int x = 0; x < read.cells.x; ++x)
                ASSERT_EQ(read.density[read.indexOf({x, y, z})], valueAt(grid, read, {x, y, z}));
}

TEST(VolumeFile, ReadsTheFogThatOpenVdbMadeOfASphereAndMakesTheSameOfTheSphereItself) {
    const TestFolder folder;
    auto grid = fog();
    grid.setTime(1.5);
    grid.setSavedAsHalf(false);
    const VolumeGrid read = readVolume(written(folder, {grid}), {});
    EXPECT_EQ(read.timeSeconds, 1.5);
    EXPECT_FLOAT_EQ(static_cast<float>(read.spacing), 0.125f);
    expectSame(grid, read);
    expectSame(grid, readVolume(written(folder, {sphere()}), {}));
}

TEST(VolumeFile, ReadsTemperatureAndVelocityInTheDensitysCells) {
    const TestFolder folder;
    const auto density = fog();
    TestGrid<float> heat("heat");
    TestGrid<glm::vec3> velocity("vel"), staggered("v");
    heat.setCellSize(0.125);
    velocity.setCellSize(0.125);
    heat.set({8, 16, 24}, 900);  // at (1, 2, 3), the middle
    velocity.set({8, 16, 24}, {1, 2, 3});
    staggered.set({8, 16, 24}, {1, 2, 3});  // cells of another edge
    const std::string file = written(folder, {density, heat, velocity, staggered});
    const VolumeGrid read = readVolume(file, {});
    ASSERT_EQ(read.temperature.size(), read.cellCount());
    ASSERT_EQ(read.velocity.size(), read.cellCount());
    const glm::ivec3 middle(glm::round((glm::dvec3(1, 2, 3) - read.origin) / read.spacing - 0.5));
    EXPECT_EQ(read.temperature[read.indexOf(middle)], 900);
    EXPECT_EQ(read.velocity[read.indexOf(middle)], glm::vec3(1, 2, 3));
    VolumeFields fields;
    fields.velocity = "v";
    EXPECT_THAT(refusalOf(file, fields), HasSubstr("its field 'v' is on a different grid from its density"));
    fields = {};
    fields.temperature = "warmth";
    fields.wantsTemperature = true;
    EXPECT_THAT(refusalOf(file, fields), HasSubstr("it has no field of numbers 'warmth'; it has: density, heat"));
}

TEST(VolumeFile, TakesTheOnlyFieldOfNumbersWhateverItsName) {
    const TestFolder folder;
    auto one = fog(), two = fog();
    one.setName("cumulus");
    EXPECT_NO_THROW((void)readVolume(written(folder, {one}), {}));
    two.setName("cirrus");
    const std::string both = written(folder, {one, two});
    EXPECT_THAT(refusalOf(both), HasSubstr("it has no field of numbers 'density'; it has: cumulus, cirrus"));
    VolumeFields fields;
    fields.density = "cirrus";
    EXPECT_NO_THROW((void)readVolume(both, fields));
}

TEST(VolumeFile, RefusesWhatIsNoDensityOnCubesAlongTheAxes) {
    const TestFolder folder;
    const auto with = [&](const std::function<void(TestGrid<float>&)>& change) {
        auto grid = fog();
        change(grid);
        return refusalOf(written(folder, {grid}));
    };
    const auto transformed = [](const glm::dmat4& matrix) {
        return [matrix](TestGrid<float>& grid) { grid.setTransform(matrix); };
    };
    const glm::dmat4 turned = glm::rotate(glm::dmat4(1), 0.3, glm::dvec3(0, 1, 0));
    const glm::dmat4 flat = glm::scale(glm::dmat4(1), glm::dvec3(1, 2, 1));
    EXPECT_THAT(with(transformed(turned)), HasSubstr("its grid is turned"));
    EXPECT_THAT(with(transformed(flat)), HasSubstr("its cells are not cubes"));
    EXPECT_THAT(with([](auto& grid) { grid.clear(); }), HasSubstr("its density is zero everywhere"));
    EXPECT_THAT(with([](auto& grid) { grid.changeBackground(0.5f); }), HasSubstr("the background is 0.5"));
    const auto negative = [](TestGrid<float>& grid) { grid.set({0, 0, 0}, -0.4f); };
    EXPECT_THAT(with(negative), HasSubstr("it has a density of -0.4, allowed: 0 or more, or clamp_density"));
    auto clamped = fog();
    negative(clamped);
    VolumeFields clamps;
    clamps.clampsDensity = true;
    const VolumeGrid read = readVolume(written(folder, {clamped}), clamps);
    EXPECT_GE(*std::ranges::min_element(read.density), 0);
    EXPECT_THAT(with([](auto& grid) { grid.set({0, 0, 0}, NAN); }), HasSubstr("is not a number"));
    EXPECT_THAT(with([](auto& grid) { grid.set({4'000, 4'000, 4'000}, 1); }), HasSubstr("more than 256 million cells"));
    EXPECT_THAT(refusalOf(folder.write("a.raw", "1")), HasSubstr("expected a file that ends in .vdb, .nvdb or .vti"));
    EXPECT_THAT(refusalOf(folder.path() / "none.vdb"), HasSubstr("none.vdb: "));
}

TEST(VolumeFile, ADensityBelowZeroByRoundingCountsAsZero) {
    const TestFolder folder;
    auto grid = fog();
    grid.set({8, 16, 24}, -0.0005f);
    const VolumeGrid read = readVolume(written(folder, {grid}), {});
    EXPECT_GE(*std::ranges::min_element(read.density), 0);
}

TEST(VolumeFile, ReadsVtksWaveletAtItsPointsWhichAreTheMiddlesOfCells) {
    const TestFolder folder;
    const std::string file = folder.path() / "wavelet.vti";
    const vtkNew<vtkRTAnalyticSource> source;
    source->SetWholeExtent(-4, 5, -3, 6, 0, 7);
    const vtkNew<vtkXMLImageDataWriter> writer;
    writer->SetInputConnection(source->GetOutputPort());
    writer->SetFileName(file.c_str());
    ASSERT_EQ(writer->Write(), 1);
    EXPECT_THAT(refusalOf(file), HasSubstr("it has a density of -"));  // a wave
    VolumeFields clamps;
    clamps.clampsDensity = true;
    const VolumeGrid read = readVolume(file, clamps);
    ASSERT_EQ(read.cells, glm::ivec3(10, 10, 8));
    EXPECT_EQ(read.origin, glm::dvec3(-4.5, -3.5, -0.5));
    vtkDataArray* const values = source->GetOutput()->GetPointData()->GetScalars();
    for (vtkIdType i = 0; i < values->GetNumberOfTuples(); ++i)
        ASSERT_EQ(read.density[static_cast<std::size_t>(i)], std::max(static_cast<float>(values->GetTuple1(i)), 0.0f));
}

TEST(VolumeFile, RefusesVtksGridOfOblongCells) {
    const TestFolder folder;
    const std::string file = folder.path() / "oblong.vti";
    const vtkNew<vtkImageData> image;
    image->SetDimensions(3, 3, 3);
    image->SetSpacing(1, 2, 1);
    image->AllocateScalars(VTK_FLOAT, 1);
    const vtkNew<vtkXMLImageDataWriter> writer;
    writer->SetInputData(image);
    writer->SetFileName(file.c_str());
    ASSERT_EQ(writer->Write(), 1);
    EXPECT_THAT(refusalOf(file), HasSubstr("its cells are not cubes: 1 x 2 x 1"));
}

TEST(VolumeFile, PartsOfAFileAreRefused) {
    const TestFolder folder;
    const std::string file = written(folder, {fog()});
    std::ifstream stream(file, std::ios::binary);
    const std::string whole(std::istreambuf_iterator<char>(stream), {});
    for (std::size_t part = 1; part < 8; ++part)
        EXPECT_THAT(refusalOf(folder.write("cut.vdb", whole.substr(0, whole.size() * part / 8))),
                    HasSubstr("cut.vdb: not a complete OpenVDB file"));
}

}  // namespace
}  // namespace dustbench::volumes
