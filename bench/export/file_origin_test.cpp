// Files of VTK state where they come from, and VTK's own readers find it.
#include <gtest/gtest.h>
#include <vtkFieldData.h>
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkVariant.h>
#include <vtkXMLImageDataReader.h>
#include <vtkXMLPolyDataReader.h>

#include "bench/export/htg_writer.h"
#include "bench/export/test_clouds.h"
#include "bench/export/vti_writer.h"
#include "bench/export/vtp_writer.h"
#include "bench/measure/provenance.h"
#include "methods/kit/files/whole_text.h"
#include "methods/kit/testing/test_folder.h"

namespace dustbench::bench {
namespace {

constexpr double originSeconds = 2.0 + 1.0 / 60;
const std::vector<std::string> someSettings{"scene=plain", "at=1s:size=2 <&> \"é\""};

template <typename Reader>
vtkDataObject& readOrigin(Reader& reader, const std::filesystem::path& file) {
    reader.SetFileName(file.c_str());
    reader.Update();
    return *reader.GetOutput();
}

void expectOrigin(vtkDataObject& data) {
    const auto texts = [&](const char* name) {
        std::vector<std::string> list;
        vtkAbstractArray* array = data.GetFieldData()->GetAbstractArray(name);
        for (vtkIdType i = 0; array && i < array->GetNumberOfValues(); ++i)
            list.push_back(array->GetVariantValue(i).ToString());
        return list;
    };
    EXPECT_EQ(texts("method"), std::vector<std::string>{"octree_search"});
    EXPECT_EQ(texts("configuration"), someSettings);
    EXPECT_EQ(texts("dustbench_version"), std::vector<std::string>{buildFacts().version});
    vtkDataArray* const time = data.GetFieldData()->GetArray("TimeValue");
    ASSERT_NE(time, nullptr);
    EXPECT_EQ(time->GetTuple1(0), originSeconds);
}

TEST(FileOrigin, IsInEveryFormatOfVtk) {
    const TestFolder folder;
    const FileOrigin origin(originSeconds, "octree_search", someSettings);
    const TestDust dust(20, 3, 0.1f, 1);
    const CollectedVolume volume = dust.volume();
    writeVti(computeGrid(volume, planGrid(volume.bounds(), 8)), origin, folder.path() / "a.vti");
    vtkNew<vtkXMLImageDataReader> grid;
    expectOrigin(readOrigin(*grid, folder.path() / "a.vti"));

    writeVtp(dust.store, origin, folder.path() / "a.vtp", std::vector<int>(20, 3));
    vtkNew<vtkXMLPolyDataReader> points;
    expectOrigin(readOrigin(*points, folder.path() / "a.vtp"));
    EXPECT_EQ(points->GetOutput()->GetPointData()->GetArray("system")->GetTuple1(19), 3);
    EXPECT_NE(points->GetOutput()->GetFieldData()->GetAbstractArray("system_unit"), nullptr);

    writeHtg({{0, 0, 0}, 1, 0, {}}, origin, folder.path() / "a.htg");
    const std::string text = files::wholeText(folder.path() / "a.htg", "an octree");  // VTK 9.1 does not read it
    for (const char* name : {"method", "configuration", "dustbench_version", "TimeValue"})
        EXPECT_NE(text.find("Name=\"" + std::string(name) + "\""), std::string::npos) << name;
}

}  // namespace
}  // namespace dustbench::bench
