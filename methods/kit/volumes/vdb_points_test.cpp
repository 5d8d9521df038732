// Tests that files written by OpenVDB's own functions are read with all their points, at any position.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <openvdb/openvdb.h>
#include <openvdb/points/PointAttribute.h>
#include <openvdb/points/PointConversion.h>

#include <map>

#include "methods/kit/testing/test_folder.h"
#include "methods/kit/volumes/vdb_process.h"

namespace dustbench::volumes {
namespace {

using testing::HasSubstr;

constexpr int count = 500;

openvdb::Vec3f placeOf(int i) {
    const int column = i % 10, row = i / 10;
    return {0.1f * static_cast<float>(column), 0.3f * static_cast<float>(row), -0.01f * static_cast<float>(i)};
}

std::string writtenPoints(const TestFolder& folder) {
    openvdb::initialize();
    std::vector<openvdb::Vec3f> places;
    std::vector<float> radii;
    std::vector<int> ids;
    for (int i = 0; i < count; ++i) {
        places.push_back(placeOf(i));
        radii.push_back(0.01f * static_cast<float>(i + 1));
        ids.push_back(i);
    }
    using namespace openvdb::points;
    const PointAttributeVector<openvdb::Vec3f> wrapper(places);
    const auto transform = openvdb::math::Transform::createLinearTransform(0.25);
    const auto index = openvdb::tools::createPointIndexGrid<openvdb::tools::PointIndexGrid>(wrapper, *transform);
    const auto grid = createPointDataGrid<NullCodec, PointDataGrid>(*index, wrapper, *transform);
    appendAttribute<float>(grid->tree(), "pscale");
    appendAttribute<int>(grid->tree(), "id");
    appendGroup(grid->tree(), "some");
    const PointAttributeVector<float> radiusWrapper(radii);
    const PointAttributeVector<int> idWrapper(ids);
    populateAttribute(grid->tree(), index->tree(), "pscale", radiusWrapper);
    populateAttribute(grid->tree(), index->tree(), "id", idWrapper);
    grid->insertMeta("time_s", openvdb::DoubleMetadata(1.5));
    const std::string file = folder.path() / "points.vdb";
    openvdb::io::File(file).write({grid});
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
    openvdb::io::File(other).write({openvdb::FloatGrid::create()});
    EXPECT_THAT(inputError([&] { (void)readAll(other); }), HasSubstr("it has no grid of points"));
}

}  // namespace
}  // namespace dustbench::volumes
