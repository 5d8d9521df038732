// Tests volumes made and written by NanoVDB's own functions. Separate from volume_file_test.cpp, due to slow headers.
#define NANOVDB_USE_ZIP
#define NANOVDB_USE_BLOSC
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nanovdb/util/IO.h>
#include <nanovdb/util/Primitives.h>

#include "methods/kit/testing/test_folder.h"
#include "methods/kit/volumes/volume_file.h"

namespace dustbench::volumes {
namespace {

using nanovdb::io::Codec;
using testing::HasSubstr;

/// A fog sphere from NanoVDB; `Build` is the storage type of its numbers.
template <typename Build>
auto nanoFog() {
    return nanovdb::createFogVolumeSphere<float, Build>(/*radius=*/2, nanovdb::Vec3f(1, 2, 3), /*voxelSize=*/0.125);
}

template <typename Handle>
std::string writtenNano(const TestFolder& folder, const Handle& handle, Codec codec = Codec::NONE) {
    const std::string path = folder.path() / "a.nvdb";
    nanovdb::io::writeGrid(path, handle, codec);
    return path;
}

/// Keeps the streamed values.
struct Kept final : VolumeSink {
    void begin(const GridPlace& at) override { place = at; }
    bool beginField(std::string_view field) override { return field == "density"; }
    void take(std::span<const float> more) override { numbers.insert(numbers.end(), more.begin(), more.end()); }
    GridPlace place;
    std::vector<float> numbers;
};

template <typename Build>
void expectRead(const TestFolder& folder, Codec codec) {
    const auto handle = nanoFog<Build>();
    const auto* const grid = handle.template grid<Build>();
    const VolumeGrid read = readVolume(writtenNano(folder, handle, codec), {});
    ASSERT_EQ(read.density.size(), read.cellCount());
    Kept kept;
    VolumeFields sparse;
    sparse.isSparse = true;
    streamVolume(folder.path() / "a.nvdb", sparse, kept);
    EXPECT_EQ(kept.numbers, read.density);
    EXPECT_EQ(kept.place.origin, read.origin);
    EXPECT_FALSE(read.timeSeconds);
    EXPECT_DOUBLE_EQ(read.spacing, 0.125);
    const auto values = grid->getAccessor();
    double sum = 0, expected = 0;
    for (int z = 0; z < read.cells.z; ++z)
        for (int y = 0; y < read.cells.y; ++y)
            for (int x = 0; x < read.cells.x; ++x) {
                const glm::dvec3 place = read.origin + read.spacing * (glm::dvec3(x, y, z) + 0.5);
                const auto index = grid->worldToIndex(nanovdb::Vec3d(place.x, place.y, place.z));
                float value = 0;
                if (!values.probeValue(nanovdb::RoundDown<nanovdb::Coord>(index + nanovdb::Vec3d(0.5)), value))
                    value = 0;
                ASSERT_EQ(read.density[read.indexOf({x, y, z})], value);
                sum += static_cast<double>(value);
            }
    // The whole ball is inside: its volume, minus the slope of its rim.
    expected = 4.0 / 3 * 3.14159265 * 8;
    EXPECT_NEAR(sum * 0.125 * 0.125 * 0.125, expected, 0.35 * expected);
}

TEST(NanoVolume, ReadsTheFogThatNanoVdbMadeInAllItsFormsOfFloats) {
    const TestFolder folder;
    expectRead<float>(folder, Codec::NONE);
    expectRead<float>(folder, Codec::ZIP);
    expectRead<float>(folder, Codec::BLOSC);
    expectRead<nanovdb::Fp8>(folder, Codec::NONE);
    expectRead<nanovdb::FpN>(folder, Codec::ZIP);
}

TEST(NanoVolume, ALevelSetBecomesTheFogThatNanoVdbMakesOfIt) {
    const TestFolder folder;
    const auto sphere = nanovdb::createLevelSetSphere<float>(2, nanovdb::Vec3f(1, 2, 3), 0.125);
    const VolumeGrid distance = readVolume(writtenNano(folder, sphere), {});
    const VolumeGrid ball = readVolume(writtenNano(folder, nanoFog<float>()), {});
    double one = 0, other = 0;
    for (const float value : distance.density) one += static_cast<double>(value);
    for (const float value : ball.density) other += static_cast<double>(value);
    EXPECT_NEAR(one, other, 0.01 * other);
}

TEST(NanoVolume, PartsOfAFileAreRefused) {
    const TestFolder folder;
    const std::string file = writtenNano(folder, nanoFog<float>(), Codec::ZIP);
    std::ifstream stream(file, std::ios::binary);
    const std::string whole(std::istreambuf_iterator<char>(stream), {});
    for (std::size_t part = 0; part < 8; ++part) {
        const auto cut = folder.write("cut.nvdb", whole.substr(0, whole.size() * part / 8));
        EXPECT_THAT(inputError([&] { (void)readVolume(cut, {}); }), HasSubstr("cut.nvdb: not a complete NanoVDB file"));
    }
}

}  // namespace
}  // namespace dustbench::volumes
