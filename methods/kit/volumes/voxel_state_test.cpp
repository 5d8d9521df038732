// Tests that inactive voxels of a grid, and vectors on faces, are read the same from .vdb and .nvdb. Separate from the
// other tests, because the headers are slow to compile.
#include <gtest/gtest.h>
#include <nanovdb/util/IO.h>
#include <nanovdb/util/OpenToNanoVDB.h>
#include <openvdb/openvdb.h>

#include <numeric>

#include "methods/kit/files/input_log.h"
#include "methods/kit/testing/test_folder.h"
#include "methods/kit/volumes/volume_file.h"

namespace dustbench::volumes {
namespace {

constexpr int edge = 4;

/// A cube of 4x4x4 voxels with values by position.
template <typename Grid, typename Value>
typename Grid::Ptr cubeOf(const char* name, openvdb::GridClass is, const Value& valueAt,
                          typename Grid::ValueType background = openvdb::zeroVal<typename Grid::ValueType>()) {
    openvdb::initialize();
    const auto grid = Grid::create(background);
    auto values = grid->getAccessor();
    for (int z = 0; z < edge; ++z)
        for (int y = 0; y < edge; ++y)
            for (int x = 0; x < edge; ++x) values.setValue({x, y, z}, valueAt(openvdb::Coord(x, y, z)));
    grid->setName(name);
    grid->setGridClass(is);
    return grid;
}

openvdb::FloatGrid::Ptr evenDensity(openvdb::GridClass is = openvdb::GRID_FOG_VOLUME) {
    return cubeOf<openvdb::FloatGrid>("density", is, [](const openvdb::Coord&) { return 1.0f; });
}

/// The grids in both formats.
std::vector<VolumeGrid> readBoth(const TestFolder& folder, const openvdb::GridPtrVec& grids) {
    openvdb::io::File(folder.path() / "a.vdb").write(grids);
    std::vector<nanovdb::GridHandle<nanovdb::HostBuffer>> handles;
    for (const openvdb::GridBase::Ptr& grid : grids)
        if (const auto numbers = openvdb::gridPtrCast<openvdb::FloatGrid>(grid))
            handles.push_back(nanovdb::OpenToNanoVDB<float, float>()(*numbers));
        else
            handles.push_back(nanovdb::OpenToNanoVDB<openvdb::Vec3f, nanovdb::Vec3f>()(
                *openvdb::gridPtrCast<openvdb::Vec3SGrid>(grid)));
    nanovdb::io::writeGrids(folder.path() / "a.nvdb", handles);
    return {readVolume(folder.path() / "a.vdb", {}), readVolume(folder.path() / "a.nvdb", {})};
}

TEST(VoxelState, AVoxelThatIsSwitchedOffHasNoDensityWhateverValueWasLeft) {
    const TestFolder folder;
    for (const auto is : {openvdb::GRID_FOG_VOLUME, openvdb::GRID_UNKNOWN})
        for (const int layer : {0, 2}) {  // at the rim, which shrinks the box, and inside
            const auto density = evenDensity(is);
            for (int z = 0; z < edge; ++z)
                for (int y = 0; y < edge; ++y) density->getAccessor().setValueOff({layer, y, z});
            for (const VolumeGrid& read : readBoth(folder, {density}))
                EXPECT_EQ(std::accumulate(read.density.begin(), read.density.end(), 0.0f), 48) << is << ' ' << layer;
        }
}

TEST(VoxelState, ATemperatureThatIsSwitchedOffIsTheBackground) {
    const TestFolder folder;
    const auto heat = cubeOf<openvdb::FloatGrid>(
        "temperature", openvdb::GRID_UNKNOWN, [](const openvdb::Coord&) { return 900.0f; }, 300.0f);
    heat->getAccessor().setValueOff({1, 2, 3});
    for (const VolumeGrid& read : readBoth(folder, {evenDensity(), heat})) {
        ASSERT_EQ(read.temperature.size(), 64u);
        EXPECT_EQ(read.temperature[read.indexOf({1, 2, 3})], 300);
        EXPECT_EQ(read.temperature[read.indexOf({2, 2, 3})], 900);
    }
}

TEST(VoxelState, LatticesThatDifferByRoundingAreOne) {
    const TestFolder folder;
    const auto heat =
        cubeOf<openvdb::FloatGrid>("temperature", openvdb::GRID_UNKNOWN, [](const openvdb::Coord&) { return 900.0f; });
    const auto density = evenDensity();
    density->setTransform(openvdb::math::Transform::createLinearTransform(0.1));
    heat->setTransform(openvdb::math::Transform::createLinearTransform(0.1 * (1 + 1e-7)));
    for (const VolumeGrid& read : readBoth(folder, {density, heat})) EXPECT_EQ(read.temperature.size(), 64u);
    heat->setTransform(openvdb::math::Transform::createLinearTransform(0.101));
    for (const VolumeGrid& read : readBoth(folder, {density, heat})) EXPECT_TRUE(read.temperature.empty());
}

TEST(VoxelState, OfTwoTemperaturesTheOneInTheDensitysCellsIsTaken) {
    const TestFolder folder;
    const auto valued = [](const char* name, float value, double size) {
        const auto grid =
            cubeOf<openvdb::FloatGrid>(name, openvdb::GRID_UNKNOWN, [value](const openvdb::Coord&) { return value; });
        grid->setTransform(openvdb::math::Transform::createLinearTransform(size));
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
openvdb::Vec3SGrid::Ptr slopes(openvdb::GridClass is) {
    return cubeOf<openvdb::Vec3SGrid>("velocity", is, [](const openvdb::Coord& at) {
        return openvdb::Vec3s(0.1f * static_cast<float>(at.x()), 0.2f * static_cast<float>(at.y()),
                              0.3f * static_cast<float>(at.z()));
    });
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
    for (const auto& [is, offset] : {std::pair(openvdb::GRID_STAGGERED, 0.5f), {openvdb::GRID_UNKNOWN, 0.0f}}) {
        for (const VolumeGrid& read : readBoth(folder, {evenDensity(), slopes(is)}))
            expectSlopes(read, read.velocity, offset);
        const VectorGrid vectors = readVectors(folder.path() / "a.vdb", "velocity");
        // The origin's voxel has the vector 0, which is active.
        expectSlopes(vectors, vectors.values, offset);
    }
}

}  // namespace
}  // namespace dustbench::volumes
