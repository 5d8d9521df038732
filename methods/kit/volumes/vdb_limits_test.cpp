// Tests small OpenVDB files that would need much memory: a box of many cells, leaves that unpack to far more than the
// file.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <openvdb/openvdb.h>

#include "methods/contract/errors.h"
#include "methods/kit/testing/test_folder.h"
#include "methods/kit/testing/test_input_error.h"
#include "methods/kit/volumes/vdb_process.h"
#include "methods/kit/volumes/vector_file.h"
#include "source_folder.h"

namespace dustbench::volumes {
namespace {

using testing::HasSubstr;

std::string writtenVdb(const TestFolder& folder, const openvdb::Vec3SGrid::Ptr& grid) {
    grid->setName("velocity");
    const std::string path = folder.path() / "a.vdb";
    openvdb::io::File file(path);
    file.setCompression(openvdb::io::COMPRESS_ZIP | openvdb::io::COMPRESS_ACTIVE_MASK);
    file.write({grid});
    return path;
}

std::string limitRefusal(const std::string& file) {
    return inputError([&] { (void)readVectors(file, "velocity"); });
}

TEST(VdbLimits, BoxesOfManyCellsAreRefused) {
    openvdb::initialize();
    const TestFolder folder;
    const auto grid = openvdb::Vec3SGrid::create();
    grid->getAccessor().setValue({0, 0, 0}, {1, 2, 3});
    grid->getAccessor().setValue({99, 99, 8'900}, {1, 2, 3});  // 8,901 layers of 10,000
    EXPECT_THAT(limitRefusal(writtenVdb(folder, grid)),
                HasSubstr("the box of its vectors has more than 89 million cells"));
}

TEST(VdbLimits, LayersArriveInOrder) {
    openvdb::initialize();
    const TestFolder folder;
    const auto grid = openvdb::Vec3SGrid::create();
    // Starts below zero, and is not a whole number of slabs.
    for (int z = -5; z < 16; ++z)
        for (int x = 0; x < 3; ++x)
            grid->getAccessor().setValue({x, 0, z}, {0.5f + static_cast<float>(x), 0.25f, static_cast<float>(z)});
    const VectorGrid read = readVectors(writtenVdb(folder, grid), "velocity");
    ASSERT_EQ(read.cells, glm::ivec3(3, 1, 21));
    for (int z = 0; z < 21; ++z)
        for (int x = 0; x < 3; ++x)
            EXPECT_EQ(read.values[static_cast<std::size_t>(z * 3 + x)],
                      glm::vec3(0.5f + static_cast<float>(x), 0.25f, static_cast<float>(z - 5)));
}

TEST(VdbLimits, ValuesThatAreAllAlikeAreNotTooMany) {
    // Compresses best: of all valid content, such leaves take the most memory for their bytes in the file.
    openvdb::initialize();
    const TestFolder folder;
    const auto grid = openvdb::Vec3SGrid::create();
    grid->tree().denseFill(openvdb::CoordBBox(0, 0, 0, 199, 199, 199), {1, 2, 3}, true);
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
