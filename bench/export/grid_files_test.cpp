// A method's own grid, written and read back: by VTK, by OpenVDB's Python module, and as a series of vectors.
#include <gtest/gtest.h>
#include <vtkCellData.h>
#include <vtkDataArray.h>
#include <vtkFieldData.h>
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkXMLImageDataReader.h>

#include <fstream>
#include <random>

#include "bench/export/format_writers.h"
#include "bench/export/test_clouds.h"
#include "methods/kit/files/matching_files.h"
#include "methods/kit/testing/python_script.h"
#include "methods/kit/testing/test_folder.h"
#include "methods/kit/testing/test_input_error.h"
#include "methods/kit/volumes/vector_series.h"

namespace dustbench::exports {
namespace {

namespace fs = std::filesystem;

TEST(GridFiles, VtiHasEveryFieldCellByCell) {
    const TestFolder folder;
    const TestGrid test;
    const CollectedVolume volume = test.volume();
    writeGridVti(volume.grids().front(), 0.5, folder.path() / "a.vti");
    vtkNew<vtkXMLImageDataReader> reader;
    reader->SetFileName((folder.path() / "a.vti").c_str());
    reader->Update();
    vtkImageData& image = *reader->GetOutput();
    EXPECT_EQ(image.GetOrigin()[2], 30);
    EXPECT_EQ(image.GetSpacing()[0], 0.25);
    ASSERT_EQ(image.GetNumberOfCells(), 60);
    for (vtkIdType c = 0; c < 60; ++c) {
        EXPECT_EQ(image.GetCellData()->GetArray("heat")->GetTuple1(c), static_cast<double>(c));
        for (int axis = 0; axis < 3; ++axis)
            EXPECT_EQ(image.GetCellData()->GetArray("velocity")->GetComponent(c, axis),
                      static_cast<double>(c + 1000 * (axis + 1)));
    }
    EXPECT_NE(image.GetFieldData()->GetAbstractArray("velocity_unit"), nullptr);
    EXPECT_EQ(image.GetFieldData()->GetArray("TimeValue")->GetTuple1(0), 0.5);
}

TEST(GridFiles, VdbHasAGridForEachFieldAtItsPlace) {
    const TestFolder folder;
    const CollectedVolume volume = TestGrid().volume();
    writeGridVdb(volume.grids().front(), 7, 0.5, folder.path() / "a.vdb");
    const std::string said = python(folder, R"(
import sys
import pyopenvdb as vdb
heat = vdb.read(sys.argv[1], 'heat')
velocity = vdb.read(sys.argv[1], 'velocity')
print(heat.getConstAccessor().getValue((3, 2, 1)), velocity.getConstAccessor().getValue((3, 2, 1)))
print(heat.transform.indexToWorld((3, 2, 1)), velocity.metadata['unit'], velocity.metadata['frame'])
)",
                                    folder.path() / "a.vdb");
    EXPECT_EQ(said, "33.0 (1033.0, 2033.0, 3033.0)\n(10.875, 20.625, 30.375) m/s 7\n");
}

// --- An exported field, read back as a series of vectors, is the same field, in the world's frame and in metres

/// A linear field of place and time, none of whose vectors is zero.
glm::vec3 flowAt(const glm::dvec3& p, double t) {
    return {20 + p.x - 2 * p.y + t, 10 - p.z + 0.5 * t, 15 + 3 * p.x + p.z};
}

CollectedGrid gridAt(double time, const glm::ivec3& cells = {6, 8, 5}) {
    CollectedGrid grid;
    grid.cells = cells;
    grid.originMetres = {3, -1, 2};
    grid.spacingMetres = 0.25;
    CollectedField density, velocity;
    density.name = "density";
    density.unit = "1";
    density.components = 1;
    velocity.name = "velocity";
    velocity.unit = "m/s";
    velocity.components = 3;
    for (int z = 0; z < cells.z; ++z)
        for (int y = 0; y < cells.y; ++y)
            for (int x = 0; x < cells.x; ++x) {
                const glm::vec3 v = flowAt(grid.originMetres + 0.25 * (glm::dvec3(x, y, z) + 0.5), time);
                density.values.push_back(1);
                velocity.values.insert(velocity.values.end(), {v.x, v.y, v.z});
            }
    grid.fields = {density, velocity};
    return grid;
}

void expectTheFlow(const volumes::VectorSeries& series) {
    std::mt19937_64 chance(7);
    std::uniform_real_distribution<double> share(0, 1);
    for (int i = 0; i < 300; ++i) {
        const glm::dvec3 within(share(chance), share(chance), share(chance));
        const glm::dvec3 point = glm::dvec3(3, -1, 2) + 0.25 * (0.5 + within * glm::dvec3(5, 7, 4));
        const double time = 2 + share(chance);
        const auto found = series.momentAt(time).at(point);
        ASSERT_TRUE(found);
        EXPECT_LT(glm::distance(*found, flowAt(point, time)), 2e-5f);
    }
    EXPECT_FALSE(series.momentAt(2).at({2.99, 0, 2.5}));
}

TEST(VectorSeriesFiles, AreReadAsTheyWereExported) {
    const TestFolder folder;
    for (const double time : {2.0, 3.0}) {
        const std::string name = "f" + std::to_string(static_cast<int>(time));
        writeGridVti(gridAt(time), time, folder.path() / (name + ".vti"));
        writeGridVdb(gridAt(time), 1, time, folder.path() / (name + ".vdb"));
    }
    for (const char* pattern : {"f*.vti", "f*.vdb"}) {
        const auto files = files::matchingFiles(folder.path() / pattern);
        ASSERT_EQ(files.size(), 2u);
        const volumes::VectorSeries series(files, "velocity");
        EXPECT_EQ(series.firstSeconds(), 2);
        EXPECT_EQ(series.lastSeconds(), 3);
        expectTheFlow(series);
    }
}

TEST(VectorSeriesFiles, ThatCannotBeUsedAreRefusedInOneLine) {
    const TestFolder folder;
    const fs::path good = folder.path() / "good.vti", goodVdb = folder.path() / "good.vdb";
    writeGridVti(gridAt(1), 1, good);
    writeGridVdb(gridAt(1), 1, 1, goodVdb);
    const auto refused = [&](const std::vector<fs::path>& files, const std::string& field = "velocity") {
        return inputError([&] { const volumes::VectorSeries series(files, field); });
    };
    const auto expectRefused = [&](const std::string& message, const std::string& expected) {
        EXPECT_NE(message.find(expected), std::string::npos) << message;
        EXPECT_EQ(message.find('\n'), std::string::npos) << message;
    };
    for (const auto& [file, notWhole] : {std::pair(good, "not a complete VTK image data file (.vti)"),
                                         std::pair(goodVdb, "not a complete OpenVDB file")}) {
        expectRefused(refused({file}, "speed"), "no field of vectors 'speed'; it has: velocity");
        expectRefused(refused({file}, "density"), "no field of vectors 'density'");
        expectRefused(refused({file, file}), "expected more than 1 s");
        const fs::path cut = folder.path() / ("cut" + file.extension().string());
        fs::copy_file(file, cut);
        fs::resize_file(cut, fs::file_size(file) / 2);
        expectRefused(refused({cut}), notWhole);
        expectRefused(refused({folder.path() / ("none" + file.extension().string())}), "cannot be read");
        expectRefused(refused({folder.write("text" + file.extension().string(), "no volume")}), notWhole);
    }
    expectRefused(refused({folder.write("a.csv", "1,2")}), ".vti or .vdb");
    const fs::path other = folder.path() / "other.vti";
    writeGridVti(gridAt(2, {6, 8, 6}), 2, other);
    expectRefused(refused({good, other}), "is on a different grid");
}

}  // namespace
}  // namespace dustbench::exports
