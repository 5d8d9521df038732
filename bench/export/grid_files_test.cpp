// A method's own grid, written and read back by VTK and by OpenVDB's Python module.
#include <gtest/gtest.h>
#include <vtkCellData.h>
#include <vtkDataArray.h>
#include <vtkFieldData.h>
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkXMLImageDataReader.h>

#include "bench/export/test_clouds.h"
#include "bench/export/vdb_writer.h"
#include "bench/export/vti_writer.h"
#include "methods/kit/testing/python_script.h"

namespace dustbench::bench {
namespace {

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

}  // namespace
}  // namespace dustbench::bench
