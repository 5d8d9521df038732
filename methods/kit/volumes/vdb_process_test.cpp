// Tests that files written by OpenVDB's own functions are read with all their points, at any position; and small files
// that would need much memory: a box of many cells, leaves that unpack to far more than the file.
#include "methods/kit/volumes/vdb_process.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <map>

#include "methods/contract/errors.h"
#include "methods/kit/testing/test_folder.h"
#include "methods/kit/testing/test_input_error.h"
#include "methods/kit/volumes/openvdb/test_grids.h"
#include "methods/kit/volumes/volume_file.h"
#include "source_folder.h"

namespace dustbench::volumes {
namespace {

using testing::HasSubstr;

constexpr int count = 500;

glm::vec3 placeOf(int i) {
    const int column = i % 10, row = i / 10;
    return {0.1f * static_cast<float>(column), 0.3f * static_cast<float>(row), -0.01f * static_cast<float>(i)};
}

std::string writtenPoints(const TestFolder& folder) {
    std::vector<glm::vec3> places;
    std::vector<float> radii;
    std::vector<int> ids;
    for (int i = 0; i < count; ++i) {
        places.push_back(placeOf(i));
        radii.push_back(0.01f * static_cast<float>(i + 1));
        ids.push_back(i);
    }
    AnyTestGrid grid = pointsGrid(places, radii, ids, /*cellSize=*/0.25);
    grid.setTime(1.5);
    const std::string file = folder.path() / "points.vdb";
    writeVdb(file, {grid});
    return file;
}

PointTable readAll(const std::filesystem::path& file) {
    return readVdbPoints(file, [](std::string_view) { return true; });
}

TEST(VdbPoints, ReadsEveryPointWithItsAttributes) {
    const TestFolder folder;
    const PointTable table = readAll(writtenPoints(folder));
    ASSERT_EQ(table.points, static_cast<std::size_t>(count));
    EXPECT_EQ(table.timeSeconds, 1.5);
    ASSERT_NE(table.find("id"), nullptr);
    EXPECT_EQ(table.find("some"), nullptr);
    std::map<int, std::size_t> places;
    for (std::size_t row = 0; row < table.points; ++row) places[static_cast<int>(table.find("id")->values[row])] = row;
    ASSERT_EQ(places.size(), table.points);
    for (int i = 0; i < count; ++i) {
        const std::size_t row = places.at(i);
        EXPECT_FLOAT_EQ(static_cast<float>(table.find("pscale")->values[row]), 0.01f * static_cast<float>(i + 1));
        for (int axis = 0; axis < 3; ++axis)
            EXPECT_NEAR(table.find(pointsColumn)->values[3 * row + static_cast<std::size_t>(axis)],
                        static_cast<double>(placeOf(i)[axis]), 1e-6);
    }
}

TEST(VdbPoints, WhatHasNoPointsOrIsCutIsRefused) {
    const TestFolder folder;
    const std::string file = writtenPoints(folder);
    std::ifstream stream(file, std::ios::binary);
    const std::string whole(std::istreambuf_iterator<char>(stream), {});
    for (std::size_t part = 1; part < 8; ++part) {
        const auto cut = folder.write("cut.vdb", whole.substr(0, whole.size() * part / 8));
        EXPECT_THAT(inputError([&] { (void)readAll(cut); }), HasSubstr("cut.vdb: not a complete OpenVDB file"));
    }
    const std::string other = folder.path() / "other.vdb";
    writeVdb(other, {TestGrid<float>()});
    EXPECT_THAT(inputError([&] { (void)readAll(other); }), HasSubstr("it has no grid of points"));
}

using testing::HasSubstr;

std::string writtenVdb(const TestFolder& folder, const TestGrid<glm::vec3>& grid) {
    const std::string path = folder.path() / "a.vdb";
    writeVdb(path, {grid}, /*isZipped=*/true);
    return path;
}

std::string limitRefusal(const std::string& file) {
    return inputError([&] { (void)readVectors(file, "velocity"); });
}

TEST(VdbLimits, BoxesOfManyCellsAreRefused) {
    const TestFolder folder;
    TestGrid<glm::vec3> grid("velocity");
    grid.set({0, 0, 0}, {1, 2, 3});
    grid.set({99, 99, 8'900}, {1, 2, 3});  // 8,901 layers of 10,000
    EXPECT_THAT(limitRefusal(writtenVdb(folder, grid)),
                HasSubstr("the box of its vectors has more than 89 million cells"));
}

TEST(VdbLimits, LayersArriveInOrder) {
    const TestFolder folder;
    TestGrid<glm::vec3> grid("velocity");
    // Starts below zero, and is not a whole number of slabs.
    for (int z = -5; z < 16; ++z)
        for (int x = 0; x < 3; ++x) grid.set({x, 0, z}, {0.5f + static_cast<float>(x), 0.25f, static_cast<float>(z)});
    const VectorGrid read = readVectors(writtenVdb(folder, grid), "velocity");
    ASSERT_EQ(read.cells, glm::ivec3(3, 1, 21));
    for (int z = 0; z < 21; ++z)
        for (int x = 0; x < 3; ++x)
            EXPECT_EQ(read.values[static_cast<std::size_t>(z * 3 + x)],
                      glm::vec3(0.5f + static_cast<float>(x), 0.25f, static_cast<float>(z - 5)));
}

TEST(VdbLimits, ValuesThatAreAllAlikeAreNotTooMany) {
    // Compresses best: of all valid content, such leaves take the most memory for their bytes in the file.
    const TestFolder folder;
    TestGrid<glm::vec3> grid("velocity");
    grid.fill({0, 0, 0}, {199, 199, 199}, {1, 2, 3});
    const std::string file = writtenVdb(folder, grid);
    EXPECT_LT(std::filesystem::file_size(file), 3'200'000u) << "thirty times as much in memory";
    EXPECT_EQ(readVectors(file, "velocity").values.size(), 8'000'000u);
}

#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)  // memory is not limited under them
TEST(VdbLimits, FilesThatAskForGigabytesAreRefused) {
    // Ten kilobytes, found by mutation: reading them took 2.1 GB.
    const auto file = std::filesystem::path(DUSTBENCH_SOURCE_DIR) / "tests/fuzz/greedy_points.vdb";
    EXPECT_THAT(inputError([&] { (void)readVdbPoints(file, [](std::string_view) { return true; }); }),
                HasSubstr("too much memory, allowed"));
}
#endif

}  // namespace
}  // namespace dustbench::volumes
