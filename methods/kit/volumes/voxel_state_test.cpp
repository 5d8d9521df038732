// Tests that inactive voxels of a grid, and vectors on faces, are read the same from .vdb and .nvdb.
#include <gtest/gtest.h>

#include <numeric>

#include "methods/kit/files/input_log.h"
#include "methods/kit/testing/test_folder.h"
#include "methods/kit/volumes/openvdb/test_grids.h"
#include "methods/kit/volumes/volume_file.h"

namespace dustbench::volumes {
namespace {

constexpr int edge = 4;

/// A cube of 4x4x4 voxels with values by position.
template <typename Value, typename ValueAt>
TestGrid<Value> cubeOf(const char* name, const char* is, const ValueAt& valueAt, const Value& background = Value()) {
    TestGrid<Value> grid(name, background);
    for (int z = 0; z < edge; ++z)
        for (int y = 0; y < edge; ++y)
            for (int x = 0; x < edge; ++x) grid.set({x, y, z}, valueAt(glm::ivec3(x, y, z)));
    grid.setClass(is);
    return grid;
}

TestGrid<float> evenDensity(const char* is = "fog volume") {
    return cubeOf<float>("density", is, [](const glm::ivec3&) { return 1.0f; });
}

/// The grids in both formats.
std::vector<VolumeGrid> readBoth(const TestFolder& folder, const std::vector<AnyTestGrid>& grids) {
    writeVdb(folder.path() / "a.vdb", grids);
    writeNanoVdb(folder.path() / "a.nvdb", grids);
    return {readVolume(folder.path() / "a.vdb", {}), readVolume(folder.path() / "a.nvdb", {})};
}

TEST(VoxelState, AVoxelThatIsSwitchedOffHasNoDensityWhateverValueWasLeft) {
    const TestFolder folder;
    for (const char* is : {"fog volume", "unknown"})
        for (const int layer : {0, 2}) {  // at the rim, which shrinks the box, and inside
            auto density = evenDensity(is);
            for (int z = 0; z < edge; ++z)
                for (int y = 0; y < edge; ++y) density.switchOff({layer, y, z});
            for (const VolumeGrid& read : readBoth(folder, {density}))
                EXPECT_EQ(std::accumulate(read.density.begin(), read.density.end(), 0.0f), 48) << is << ' ' << layer;
        }
}

TEST(VoxelState, ATemperatureThatIsSwitchedOffIsTheBackground) {
    const TestFolder folder;
    auto heat = cubeOf<float>(
        "temperature", "unknown", [](const glm::ivec3&) { return 900.0f; }, /*background=*/300);
    heat.switchOff({1, 2, 3});
    for (const VolumeGrid& read : readBoth(folder, {evenDensity(), heat})) {
        ASSERT_EQ(read.temperature.size(), 64u);
        EXPECT_EQ(read.temperature[read.indexOf({1, 2, 3})], 300);
        EXPECT_EQ(read.temperature[read.indexOf({2, 2, 3})], 900);
    }
}

TEST(VoxelState, LatticesThatDifferByRoundingAreOne) {
    const TestFolder folder;
    auto heat = cubeOf<float>("temperature", "unknown", [](const glm::ivec3&) { return 900.0f; });
    auto density = evenDensity();
    density.setCellSize(0.1);
    heat.setCellSize(0.1 * (1 + 1e-7));
    for (const VolumeGrid& read : readBoth(folder, {density, heat})) EXPECT_EQ(read.temperature.size(), 64u);
    heat.setCellSize(0.101);
    for (const VolumeGrid& read : readBoth(folder, {density, heat})) EXPECT_TRUE(read.temperature.empty());
}

TEST(VoxelState, OfTwoTemperaturesTheOneInTheDensitysCellsIsTaken) {
    const TestFolder folder;
    const auto valued = [](const char* name, float value, double size) {
        auto grid = cubeOf<float>(name, "unknown", [value](const glm::ivec3&) { return value; });
        grid.setCellSize(size);
        return grid;
    };
    for (const VolumeGrid& read :
         readBoth(folder, {evenDensity(), valued("heat", 700, 0.5), valued("temperature", 900, 1)})) {
        ASSERT_EQ(read.temperature.size(), 64u);
        EXPECT_EQ(read.temperature.front(), 900);
    }
    for (const char* file : {"a.vdb", "a.nvdb"}) {
        const files::InputLog log;
        (void)readVolume(folder.path() / file, {});
        EXPECT_EQ(log.ignored().at(folder.path() / file), std::vector<std::string>{"grid 'heat'"}) << file;
    }
}

/// Each component is linear along its own axis: 0.1, 0.2 and 0.3 per voxel.
TestGrid<glm::vec3> slopes(const char* is) {
    return cubeOf<glm::vec3>("velocity", is,
                             [](const glm::ivec3& at) { return glm::vec3(0.1f, 0.2f, 0.3f) * glm::vec3(at); });
}

TEST(VoxelState, StaggeredVelocitiesAreTheMeansOfTheirTwoFaces) {
    const TestFolder folder;
    const auto expectSlopes = [](const GridPlace& place, const std::vector<glm::vec3>& velocity, float offset) {
        ASSERT_EQ(velocity.size(), 64u);
        for (int z = 0; z < edge; ++z)
            for (int y = 0; y < edge; ++y)
                for (int x = 0; x < edge; ++x) {
                    const glm::vec3& found = velocity[place.indexOf({x, y, z})];
                    const glm::ivec3 cell(x, y, z);
                    for (int axis = 0; axis < 3; ++axis) {  // the last face has none above it
                        const float middle = static_cast<float>(cell[axis]) + (cell[axis] + 1 < edge ? offset : 0.0f);
                        ASSERT_NEAR(found[axis], 0.1f * static_cast<float>(axis + 1) * middle, 1e-6f);
                    }
                }
    };
    for (const auto& [is, offset] : {std::pair("staggered", 0.5f), {"unknown", 0.0f}}) {
        for (const VolumeGrid& read : readBoth(folder, {evenDensity(), slopes(is)}))
            expectSlopes(read, read.velocity, offset);
        const VectorGrid vectors = readVectors(folder.path() / "a.vdb", "velocity");
        // The origin's voxel has the vector 0, which is active.
        expectSlopes(vectors, vectors.values, offset);
    }
}

}  // namespace
}  // namespace dustbench::volumes
