// VTK and OpenImageIO read back the surfaces that were written.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <vtkDataArray.h>
#include <vtkFieldData.h>
#include <vtkIdList.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkXMLPolyDataReader.h>

#include <cmath>

#include "bench/export/format_writers.h"
#include "methods/kit/pictures/image.h"
#include "methods/kit/testing/test_folder.h"

namespace dustbench::exports {
namespace {

constexpr double someSeconds = 2.0 + 1.0 / 60;

/// A lattice of 5 × 4 points whose numbers all identify their point.
CollectedSurface numberedSurface() {
    CollectedSurface surface{"wall", 5, 4, {}, {}, {}, {{"depth_removed", "m", 1, {}}}};
    for (int i = 0; i < 20; ++i) {
        const auto number = static_cast<float>(i);
        surface.position.emplace_back(i % 5, i / 5, 0.01f * number);
        surface.colour.emplace_back(number, 0.5f, 0);
        surface.height.push_back(number / 20);
        surface.fields[0].values.push_back(2 * number);
    }
    return surface;
}

TEST(SurfaceFile, ReadsBackAsAMeshThatFacesForward) {
    const TestFolder folder;
    const CollectedSurface surface = numberedSurface();
    writeSurface(surface, someSeconds, folder.path() / "a.vtp");
    vtkNew<vtkXMLPolyDataReader> reader;
    reader->SetFileName((folder.path() / "a.vtp").c_str());
    reader->Update();
    vtkPolyData& mesh = *reader->GetOutput();
    ASSERT_NE(mesh.GetFieldData()->GetArray("TimeValue"), nullptr);
    EXPECT_EQ(mesh.GetFieldData()->GetArray("TimeValue")->GetTuple1(0), someSeconds);
    ASSERT_EQ(mesh.GetNumberOfPoints(), 20);
    ASSERT_EQ(mesh.GetNumberOfPolys(), 4 * 3);
    for (const char* unit : {"colour_unit", "height_unit", "depth_removed_unit"})
        EXPECT_NE(mesh.GetFieldData()->GetAbstractArray(unit), nullptr) << unit;
    const auto at = [&](const char* name, vtkIdType i) { return mesh.GetPointData()->GetArray(name)->GetTuple1(i); };
    for (vtkIdType i = 0; i < 20; ++i) {
        const double* point = mesh.GetPoint(i);
        ASSERT_EQ(glm::vec3(point[0], point[1], point[2]), surface.position[static_cast<std::size_t>(i)]);
        EXPECT_EQ(at("height", i), static_cast<double>(surface.height[static_cast<std::size_t>(i)]));
        EXPECT_EQ(at("depth_removed", i), 2.0 * static_cast<double>(i));
        EXPECT_EQ(mesh.GetPointData()->GetArray("colour")->GetComponent(i, 0), static_cast<double>(i));
    }
    double area = 0;
    for (vtkIdType n = 0; n < mesh.GetNumberOfCells(); ++n) {
        vtkNew<vtkIdList> corners;
        mesh.GetCellPoints(n, corners);
        ASSERT_EQ(corners->GetNumberOfIds(), 4);
        for (vtkIdType k = 0; k < 4; ++k) {  // by the shoelace formula; positive: counter-clockwise from the front
            double a[3], b[3];
            mesh.GetPoint(corners->GetId(k), a);
            mesh.GetPoint(corners->GetId((k + 1) % 4), b);
            area += 0.5 * (a[0] * b[1] - b[0] * a[1]);
        }
    }
    EXPECT_NEAR(area, 12, 1e-12);
}

TEST(SurfaceFile, HeightsReadBackFromTheTopRowDown) {
    const TestFolder folder;
    writeHeights(numberedSurface(), folder.path() / "a.exr");
    const pictures::Image picture = pictures::readImage(folder.path() / "a.exr");
    ASSERT_EQ(picture.width, 5);
    ASSERT_EQ(picture.height, 4);
    for (int row = 0; row < 4; ++row)
        for (int column = 0; column < 5; ++column)
            EXPECT_EQ(picture.at(column, 3 - row), glm::vec4(glm::vec3(static_cast<float>(5 * row + column) / 20), 1));
}

TEST(StateTextureFile, ReadsBackAllFourChannelsAsTheyAre) {
    const TestFolder folder;
    CollectedTexture texture{"wall position", 3, 2, {}};
    for (int i = 0; i < 6; ++i)
        texture.texels.emplace_back(-0.5f * static_cast<float>(i), 1e-4f, 7, 100 * static_cast<float>(i));
    writeTexture(texture, folder.path() / "a.exr");
    const pictures::Image picture = pictures::readImage(folder.path() / "a.exr");
    ASSERT_EQ(picture.width, 3);
    ASSERT_EQ(picture.height, 2);
    EXPECT_EQ(picture.pixels, texture.texels);
}

TEST(StateTextureFile, RefusesWrongSizesAndNumbersThatAreNone) {
    std::vector<glm::vec4> texels(6, glm::vec4(1));
    CollectedVolume volume;
    volume.texture({"state", 3, 2, texels});
    EXPECT_EQ(volume.textures().size(), 1u);
    EXPECT_TRUE(volume.isNothing()) << "a texture is not part of the cloud";
    EXPECT_THROW(volume.texture({"state", 2, 2, texels}), std::runtime_error);
    texels[4].y = NAN;
    EXPECT_THROW(volume.texture({"state", 3, 2, texels}), std::runtime_error);
}

TEST(CollectedSurfaces, RefuseColumnsOfAnotherSizeAndNumbersThatAreNone) {
    const CollectedSurface good = numberedSurface();
    const auto reason = [](const CollectedSurface& surface) {
        const std::vector<GridField> fields{{"depth_removed", "m", 1, surface.fields[0].values}};
        try {
            CollectedVolume().surface({surface.name, surface.columns, surface.rows, surface.position, surface.colour,
                                       surface.height, fields});
        } catch (const std::runtime_error& error) {
            return std::string(error.what());
        }
        return std::string();
    };
    EXPECT_EQ(reason(good), "");
    CollectedSurface bad = good;
    bad.height.pop_back();
    EXPECT_THAT(reason(bad), testing::HasSubstr("surface wall of 5x4 points: height has 19 numbers, expected 20"));
    bad = good;
    bad.fields[0].values[7] = NAN;
    EXPECT_THAT(reason(bad), testing::HasSubstr("depth_removed of point 7"));
    bad = good;
    bad.position[3].y = INFINITY;
    EXPECT_THAT(reason(bad), testing::HasSubstr("position of point 3"));
}

}  // namespace
}  // namespace dustbench::exports
