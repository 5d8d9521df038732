#include "bench/export/scene_writer.h"

#include <gtest/gtest.h>
#include <vtkMultiBlockDataSet.h>
#include <vtkNew.h>
#include <vtkPolyData.h>
#include <vtkXMLMultiBlockDataReader.h>

#include "methods/kit/testing/test_folder.h"

namespace dustbench::bench {
namespace {

TEST(SceneWriter, WritesSolidsWhereAndAsTheyAreAtTheMoment) {
    const TestFolder folder;
    auto triangle = std::make_shared<scene::Mesh>();
    triangle->positions = {{0, 0, 0}, {1, 0, 0}, {0, 0, 2}};
    triangle->normals.assign(3, {0, 1, 0});
    triangle->colours.assign(3, {1, 1, 1});
    triangle->indices = {0, 2, 1};
    scene::Scene scene;
    scene.solids = {{"sail", triangle, scene::SolidMotion::deforms}};
    scene.solidPoses.resize(1);
    scene::SceneState state;
    auto shape = std::make_shared<scene::DeformedMesh>(scene::DeformedMesh{*triangle, {}});
    shape->mesh.positions[1].x = 3;
    scene::SolidPose pose;
    pose.toWorld[3] = glm::vec4(200, 5, 6, 1);
    state.solids = {{pose, shape}};

    const Box ground = groundAround({}, scene, state);
    EXPECT_GT(ground.maximum.x, 203);
    const auto file = folder.path() / "f.vtm";
    writeScene(scene, state, ground, 0, file);
    vtkNew<vtkXMLMultiBlockDataReader> reader;
    reader->SetFileName(file.c_str());
    reader->Update();
    auto* blocks = vtkMultiBlockDataSet::SafeDownCast(reader->GetOutput());
    ASSERT_EQ(blocks->GetNumberOfBlocks(), 2u);  // and the ground
    double bounds[6];
    vtkPolyData::SafeDownCast(blocks->GetBlock(1))->GetBounds(bounds);
    EXPECT_EQ(bounds[0], 200);
    EXPECT_EQ(bounds[1], 203);
    EXPECT_EQ(bounds[2], 5);
    EXPECT_EQ(bounds[5], 8);
}

}  // namespace
}  // namespace dustbench::bench
