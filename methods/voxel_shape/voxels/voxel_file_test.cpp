#include "methods/voxel_shape/voxels/voxel_file.h"

#include <gtest/gtest.h>

#include <cstring>
#include <fstream>
#include <sstream>

#include "methods/kit/testing/test_folder.h"
#include "methods/voxel_shape/voxels/surface_voxels.h"
#include "methods/voxel_shape/voxels/test_meshes.h"

namespace dustbench::voxel_shape {
namespace {

/// A sphere in which every attribute varies from voxel to voxel.
VoxelGrid varied(MemoryLedger& ledger) {
    const scene::Mesh sphere = sphereMesh(1, 12);
    VoxelGrid grid(ledger, surfaceVoxels(sphere, latticeAround(sphere, 9)), Voxel());
    grid.shareOut(1234);
    float number = 0;
    for (const std::uint32_t i : grid.active()) {
        Voxel& voxel = grid.voxels()[i];
        number += 1;
        voxel.fadingColour = PackedColour({number / 400, 0.5f, 1, 0.25f});
        voxel.sizeMetres = 0.01f * number;
        voxel.fadingSizeMetres = 0.02f * number;
        voxel.lifetimeSeconds = number;
        voxel.interpolationSeconds = number / 2;
        voxel.picturesPerSecond = number / 4;
        voxel.setForce(static_cast<Force>(i % 4), {number, 1, -number}, 0.5f);
    }
    return grid;
}

TEST(VoxelFile, GivesEveryAttributeBack) {
    const TestFolder folder;
    MemoryLedger ledger;
    const VoxelGrid grid = varied(ledger);
    const auto file = folder.path() / "sphere.vti";
    writeVoxels(grid, file);
    const VoxelGrid again = readVoxels(ledger, file);
    EXPECT_EQ(again.lattice().counts, grid.lattice().counts);
    EXPECT_EQ(again.lattice().origin, grid.lattice().origin);
    EXPECT_EQ(again.lattice().edgeMetres, grid.lattice().edgeMetres);
    ASSERT_EQ(again.active().size(), grid.active().size());
    for (std::size_t i = 0; i < grid.voxels().size(); ++i) {
        Voxel expected = grid.voxels()[i], got = again.voxels()[i];
        ASSERT_NEAR(got.forceNumber, expected.forceNumber, 1e-6f * std::abs(expected.forceNumber));
        got.forceNumber = expected.forceNumber;
        // Bit by bit. NOLINTNEXTLINE(bugprone-suspicious-memory-comparison)
        ASSERT_EQ(std::memcmp(&got, &expected, sizeof got), 0) << i;
    }
}

TEST(VoxelFile, SaysInOneLineWhatIsWrong) {
    const TestFolder folder;
    MemoryLedger ledger;
    const auto file = folder.path() / "sphere.vti";
    writeVoxels(varied(ledger), file);
    std::stringstream whole;
    whole << std::ifstream(file, std::ios::binary).rdbuf();
    const std::string text = whole.str();
    const auto message = [&](const std::string& content) {
        const auto broken = folder.write("broken.vti", content);
        ::testing::internal::CaptureStderr();
        const std::string line = inputError([&] { (void)readVoxels(ledger, broken); });
        EXPECT_EQ(::testing::internal::GetCapturedStderr(), "");
        EXPECT_NE(line.find("broken.vti: "), std::string::npos) << line;
        return line;
    };
    const auto with = [&](const std::string& what, const std::string& instead) {
        std::string changed = text;
        const auto at = changed.find(what);
        EXPECT_NE(at, std::string::npos) << what;
        return changed.replace(at, what.size(), instead);
    };
    for (const std::size_t size : {std::size_t{0}, std::size_t{100}, text.size() / 2, text.size() - 40})
        EXPECT_NE(message(text.substr(0, size)).find("not a complete"), std::string::npos) << size;
    EXPECT_NE(message("something else").find("not a complete"), std::string::npos);
    EXPECT_NE(message(with("dustbench_voxels", "somebodys_voxels")).find("not a dustbench voxel file"),
              std::string::npos);
    EXPECT_NE(message(with("\"lifetime_seconds\"", "\"livetime_seconds\"")).find("'lifetime_seconds'"),
              std::string::npos);
    VoxelGrid grid = varied(ledger);
    grid.voxels()[0].lifetimeSeconds = -3;
    writeVoxels(grid, file);
    EXPECT_NE(inputError([&] { (void)readVoxels(ledger, file); }).find("voxel 0 has -3"), std::string::npos);
    EXPECT_NE(inputError([&] { (void)readVoxels(ledger, folder.path() / "none.vti"); }).find("cannot be read"),
              std::string::npos);
    EXPECT_NE(inputError([&] { writeVoxels(grid, folder.path() / "no" / "such.vti"); }).find("cannot be written"),
              std::string::npos);
}

}  // namespace
}  // namespace dustbench::voxel_shape
