// VTK's own reader reads back the scene that was written.
#include "bench/export/scene_writer.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <vtkCompositeDataSet.h>
#include <vtkDataArray.h>
#include <vtkInformation.h>
#include <vtkMultiBlockDataSet.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkXMLMultiBlockDataReader.h>

#include <map>

#include "methods/kit/testing/test_folder.h"

namespace dustbench::exports {
namespace {
namespace fs = std::filesystem;

constexpr double sceneSeconds = 2.0 + 1.0 / 60;

vtkMultiBlockDataSet& readBlocks(vtkXMLMultiBlockDataReader& reader, const fs::path& file) {
    EXPECT_TRUE(reader.CanReadFile(file.c_str()));
    reader.SetFileName(file.c_str());
    reader.Update();
    EXPECT_EQ(reader.GetErrorCode(), 0u);
    return *vtkMultiBlockDataSet::SafeDownCast(reader.GetOutput());
}

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
    vtkMultiBlockDataSet& blocks = readBlocks(*reader, file);
    ASSERT_EQ(blocks.GetNumberOfBlocks(), 2u);  // and the ground
    double bounds[6];
    vtkPolyData::SafeDownCast(blocks.GetBlock(1))->GetBounds(bounds);
    EXPECT_EQ(bounds[0], 200);
    EXPECT_EQ(bounds[1], 203);
    EXPECT_EQ(bounds[2], 5);
    EXPECT_EQ(bounds[5], 8);
}

/// A car somewhere on a slope, and a solid.
struct SmallWorld {
    scene::Scene scene;
    scene::SceneState state;

    SmallWorld() {
        std::vector<float> heights;
        for (int j = 0; j < 60; ++j)
            for (int i = 0; i < 80; ++i) heights.push_back(0.1f * static_cast<float>((i * 7 + j * 3) % 11));
        scene.terrain = scene::Terrain(heights, 80, 60, 2, -75, -50);
        auto triangle = std::make_shared<scene::Mesh>();
        triangle->positions = {{0, 0, 0}, {1, 0, 0}, {0, 0, 2}};
        triangle->normals.assign(3, {0, 1, 0});
        triangle->colours.assign(3, {1, 0.2140411f, 0});
        triangle->indices = {0, 2, 1};
        scene.vehicle = scene::VehicleModel{{}, {"body", triangle}, {"wheel", triangle}};
        scene.solids = {{"a post", triangle}};
        scene.solidPoses.resize(1);
        scene.solidPoses[0].toWorld[3] = {4, 5, 6, 1};
        state.vehicle.position = {3, 1, -2};
        for (int wheel = 0; wheel < 4; ++wheel)
            state.vehicle.wheels[static_cast<std::size_t>(wheel)].hub = {wheel, 1, 2};
    }
};

TEST(SceneFile, WhatDoesNotChangeIsWrittenOnceForAllFrames) {
    const TestFolder folder;
    SmallWorld world;
    const Box ground{{-20, 0, -10}, {30, 5, 12}};
    writeScene(world.scene, world.state, ground, 0, folder.path() / "f000000.vtm");
    const auto pieces = [&] { return std::distance(fs::directory_iterator(folder.path() / "scene"), {}); };
    const auto first = pieces();
    world.state.vehicle.position.x += 1;
    for (auto& wheel : world.state.vehicle.wheels) wheel.hub.x += 1;
    writeScene(world.scene, world.state, ground, 1, folder.path() / "f000001.vtm");
    EXPECT_EQ(pieces(), first + 5);  // body and wheels
    for (const char* name : {"f000000.vtm", "f000001.vtm"}) {
        vtkNew<vtkXMLMultiBlockDataReader> reader;
        vtkMultiBlockDataSet& blocks = readBlocks(*reader, folder.path() / name);
        ASSERT_EQ(blocks.GetNumberOfBlocks(), 7u) << name;
        for (unsigned i = 0; i < 7; ++i)
            EXPECT_GT(vtkPolyData::SafeDownCast(blocks.GetBlock(i))->GetNumberOfPolys(), 0) << name << " " << i;
    }
}

TEST(SceneFile, BlocksStandWhereTheSceneHasThem) {
    const TestFolder folder;
    const SmallWorld world;
    const Box cloud{{-20, 0, -10}, {30, 5, 12}};
    for (int again = 0; again < 2; ++again)  // also over an existing file
        writeScene(world.scene, world.state, groundAround(cloud, world.scene, world.state), sceneSeconds,
                   folder.path() / "f000007.vtm");
    EXPECT_EQ(std::distance(fs::directory_iterator(folder.path()), {}), 2);  // the file and the folder of its pieces

    vtkNew<vtkXMLMultiBlockDataReader> reader;
    vtkMultiBlockDataSet& blocks = readBlocks(*reader, folder.path() / "f000007.vtm");
    std::map<std::string, vtkPolyData*> surfaces;
    for (unsigned i = 0; i < blocks.GetNumberOfBlocks(); ++i)
        surfaces[blocks.GetMetaData(i)->Get(vtkCompositeDataSet::NAME())] =
            vtkPolyData::SafeDownCast(blocks.GetBlock(i));
    std::vector<std::string> names;
    names.reserve(surfaces.size());
    for (const auto& [name, surface] : surfaces) names.push_back(name);
    EXPECT_THAT(names, testing::UnorderedElementsAre("terrain", "body", "wheel_front_left", "wheel_front_right",
                                                     "wheel_rear_left", "wheel_rear_right", "a post"));

    const scene::VehiclePoses poses = vehiclePoses(*world.scene.vehicle, world.state.vehicle);
    const auto expectPlaced = [&](const std::string& name, const glm::mat4& toWorld) {
        vtkPolyData* surface = surfaces.at(name);
        const auto& positions = world.scene.solids[0].mesh->positions;
        ASSERT_EQ(surface->GetNumberOfPoints(), 3);
        ASSERT_EQ(surface->GetNumberOfPolys(), 1);
        for (std::size_t i = 0; i < 3; ++i) {
            const double* point = surface->GetPoint(static_cast<vtkIdType>(i));
            const glm::vec3 expected = toWorld * glm::vec4(positions[i], 1);
            EXPECT_LT(glm::distance(glm::vec3(point[0], point[1], point[2]), expected), 1e-5f) << name;
        }
        vtkDataArray* colour = surface->GetPointData()->GetArray("colour");
        EXPECT_EQ(colour->GetComponent(0, 0), 255);
        EXPECT_EQ(colour->GetComponent(0, 1), 127);  // half the perceived brightness is 0.214 in linear light
        EXPECT_EQ(colour->GetComponent(0, 2), 0);
    };
    expectPlaced("body", poses.body.toWorld);
    expectPlaced("wheel_rear_left", poses.wheels[scene::rearLeft].toWorld);
    expectPlaced("a post", world.scene.solidPoses[0].toWorld);

    vtkPolyData* ground = surfaces.at("terrain");
    for (vtkIdType i = 0; i < ground->GetNumberOfPoints(); ++i) {
        const double* point = ground->GetPoint(i);
        ASSERT_NEAR(point[1],
                    static_cast<double>(
                        world.scene.terrain.heightAt(static_cast<float>(point[0]), static_cast<float>(point[2]))),
                    1e-5);
    }
    double bounds[6];
    ground->GetBounds(bounds);
    EXPECT_LE(bounds[0], -20);
    EXPECT_GE(bounds[1], 30);
    EXPECT_LE(bounds[4], -10);
    EXPECT_GE(bounds[5], 12);
    EXPECT_LT(bounds[1] - bounds[0], 50 + 2 * 20 + 2 * 2 + 1e-6);
}

TEST(SceneFile, APlaneReachesUnderTheSolids) {
    SmallWorld world;
    world.scene.solidPoses[0].toWorld[3] = {900, 0, -700, 1};
    EXPECT_LT(groundAround({}, world.scene, world.state).maximum.x, 100);
    world.scene.terrain = {};
    EXPECT_GT(groundAround({}, world.scene, world.state).maximum.x, 900);
    EXPECT_LT(groundAround({}, world.scene, world.state).minimum.z, -700);
}

TEST(SceneFile, AVastGroundIsThinnedOut) {
    const TestFolder folder;
    SmallWorld world;
    world.scene.solids.clear();
    writeScene(world.scene, world.state, {{-5e4, 0, -5e4}, {5e4, 0, 5e4}}, sceneSeconds, folder.path() / "a.vtm");
    vtkNew<vtkXMLMultiBlockDataReader> reader;
    auto* ground = vtkPolyData::SafeDownCast(readBlocks(*reader, folder.path() / "a.vtm").GetBlock(0));
    EXPECT_LE(ground->GetNumberOfPoints(), 1 << 18);
    EXPECT_GT(ground->GetNumberOfPoints(), 1 << 14);
}

}  // namespace
}  // namespace dustbench::exports
